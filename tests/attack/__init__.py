"""The standing attack on prover and checker: oracle, designs, mutants; shares no code with either."""
