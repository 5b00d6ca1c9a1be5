"""Patients as DICOM identifies them: by ID and issuer, never by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Patient:
    """The identity of a patient.

    Attributes
    ----------
    id : str, default ""
        The PatientID without padding; empty where none is stated.
    issuer : str, default ""
        The IssuerOfPatientID without padding; empty where none is stated.
    """

    id: str = ""
    issuer: str = ""

    @classmethod
    def of(cls, patient_id: object, issuer: object) -> Patient:
        """Return the patient that two values of a header name; both may be padded or None."""
        return cls(_unpadded(patient_id), _unpadded(issuer))

    @classmethod
    def in_header(cls, header: Any) -> Patient:
        """Return the patient that a DICOM header names."""
        return cls.of(header.get("PatientID"), header.get("IssuerOfPatientID"))

    def is_comparable(self, other: Patient) -> bool:
        """Return whether both patients have an ID."""
        return bool(self.id and other.id)

    def differs_from(self, other: Patient) -> bool:
        """Return whether both have an ID, and are different patients.

        Issuers count if both are stated, because two hospitals can give the same ID to two patients.
        """
        has_other_issuer = bool(self.issuer and other.issuer) and self.issuer != other.issuer
        return self.is_comparable(other) and (self.id != other.id or has_other_issuer)

    def has_lone_issuer(self, other: Patient) -> bool:
        """Return whether the IDs are the same and only one of both patients has an issuer."""
        return self.is_comparable(other) and self.id == other.id and bool(self.issuer) != bool(other.issuer)

    def __str__(self) -> str:
        """Return the ID, with its issuer if stated."""
        if not self.id:
            return "no PatientID"
        issuer = f" of {self.issuer!r}" if self.issuer else ""
        return f"PatientID {self.id!r}{issuer}"


def _unpadded(value: object) -> str:
    """Return a value without padding spaces and zero bytes."""
    text = "" if value is None else str(value).strip(" \0\t\r\n")
    return "".join(letter if letter.isprintable() else "�" for letter in text)
