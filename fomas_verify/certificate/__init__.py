"""The certificate: what is claimed about a design, with what is needed to see it. Format:
docs/certificate-format.md.
"""

from fomas_verify.certificate.document import FORMAT, certificate_text

__all__ = ["FORMAT", "certificate_text"]
