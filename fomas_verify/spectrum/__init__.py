"""What the closed loop's matrices do: lambda2, sigma, eigenvalues, Lyapunov forms."""
