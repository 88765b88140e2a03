//! SHA-256 and ECDSA over NIST P-256, as IEEE 1609.2 composes them (clause 5.3.1).

use std::fmt;

use p256::ecdsa::signature::hazmat::{PrehashSigner, PrehashVerifier};
use p256::ecdsa::{self, SigningKey, VerifyingKey};
use p256::elliptic_curve::Generate;
use p256::elliptic_curve::sec1::ToSec1Point as _;
use p256::pkcs8::{DecodePrivateKey, EncodePrivateKey, LineEnding};

use super::coer::OerReader;
use super::rejected::{Malformed, Rejected};

/// A SHA-256 digest.
pub(super) type Digest = [u8; 32];

/// The octets of a signature: tag of the curve, tag of the form of `rSig`, `rSig`, `sSig`.
pub(super) const SIGNATURE_LEN: usize = 66;
/// `ecdsaNistP256Signature`.
const NIST_P256: u8 = 0x80;
/// `rSig` as its x coordinate alone.
const X_ONLY: u8 = 0x80;
const COMPRESSED_Y_0: u8 = 0x82;
const COMPRESSED_Y_1: u8 = 0x83;

pub(super) fn sha256(octets: &[u8]) -> Digest {
    use p256::ecdsa::signature::digest::Digest as _;
    sha2::Sha256::digest(octets).into()
}

/// What is signed: the digest of the data's digest and of the signer's certificate's, which is the
/// empty string for who signs for itself.
pub(super) fn to_be_signed(data: &[u8], signer: Option<&Digest>) -> Digest {
    let signer = signer.copied().unwrap_or_else(|| sha256(&[]));
    sha256(&[sha256(data), signer].concat())
}

/// A private key. It prints as nothing, and is wiped from memory when it is dropped.
#[derive(Clone)]
pub struct PrivateKey(SigningKey);

/// A public key, valid: a point on the curve.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PublicKey(VerifyingKey);

/// A signature, valid in form: both numbers are in range.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Signature(ecdsa::Signature);

/// A text or number that is no private key of NIST P-256.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("not a private key of NIST P-256 (PKCS #8 in PEM)")]
pub struct NoKey;

impl fmt::Debug for PrivateKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("PrivateKey")
    }
}

impl PrivateKey {
    /// A new key, from the operating system's random numbers.
    #[must_use]
    pub fn generate() -> Self {
        Self(SigningKey::generate())
    }

    /// The key with this number, big-endian.
    ///
    /// # Errors
    /// When it is zero or beyond the order of the curve.
    pub fn of_octets(octets: &[u8; 32]) -> Result<Self, NoKey> {
        SigningKey::from_slice(octets).map(Self).map_err(|_| NoKey)
    }

    /// The key in a text in PEM (PKCS #8).
    ///
    /// # Errors
    /// When there is none.
    pub fn of_pem(text: &str) -> Result<Self, NoKey> {
        SigningKey::from_pkcs8_pem(text)
            .map(Self)
            .map_err(|_| NoKey)
    }

    /// The key as a text in PEM (PKCS #8). It is wiped from memory when it is dropped.
    ///
    /// # Errors
    /// None that a valid key meets.
    pub fn to_pem(&self) -> Result<impl AsRef<str> + use<>, NoKey> {
        struct Text<T>(T);
        impl<T: std::ops::Deref<Target = String>> AsRef<str> for Text<T> {
            fn as_ref(&self) -> &str {
                &self.0
            }
        }
        let text = self.0.to_pkcs8_pem(LineEnding::LF).map_err(|_| NoKey)?;
        Ok(Text(text))
    }

    /// Its public key.
    #[must_use]
    pub fn public_key(&self) -> PublicKey {
        PublicKey(*self.0.verifying_key())
    }

    /// Signs a digest. The same key and digest give the same signature (RFC 6979).
    pub(super) fn sign(&self, digest: &Digest) -> Signature {
        let signature = self.0.sign_prehash(digest);
        Signature(signature.expect("a digest of 256 bits can be signed"))
    }
}

impl PublicKey {
    /// Reads an `EccP256CurvePoint` in compressed form, the canonical one.
    pub(super) fn read(reader: &mut OerReader, field: &'static str) -> Result<Self, Rejected> {
        let parity = match reader.octet(field)? {
            COMPRESSED_Y_0 => 2,
            COMPRESSED_Y_1 => 3,
            0x84 => return Err(Rejected::Unsupported("a key that is not compressed")),
            found => return Err(Malformed::Value { field, found }.into()),
        };
        let mut point = [parity; 33];
        point[1..].copy_from_slice(&reader.array::<32>(field)?);
        let key = VerifyingKey::from_sec1_bytes(&point);
        Ok(Self(key.map_err(|_| Malformed::NotOnCurve { field })?))
    }

    /// The parity of y and the x coordinate.
    pub(super) fn coordinates(&self) -> (bool, [u8; 32]) {
        let point = self.0.as_affine().to_sec1_point(true);
        let mut x = [0; 32];
        x.copy_from_slice(&point.as_bytes()[1..]);
        (point.as_bytes()[0] == 3, x)
    }

    pub(super) fn verifies(&self, digest: &Digest, signature: &Signature) -> bool {
        self.0.verify_prehash(digest, &signature.0).is_ok()
    }
}

impl Signature {
    /// Reads a `Signature`. Of `rSig` only the form x-only is taken, the canonical one.
    pub(super) fn read(reader: &mut OerReader) -> Result<Self, Rejected> {
        match reader.octet("signature")? {
            NIST_P256 => {}
            0x81..=0x84 => return Err(Rejected::Unsupported("a curve other than NIST P-256")),
            found => {
                let field = "signature";
                return Err(Malformed::Value { field, found }.into());
            }
        }
        match reader.octet("rSig")? {
            X_ONLY => {}
            COMPRESSED_Y_0 | COMPRESSED_Y_1 | 0x84 => {
                return Err(Rejected::Unsupported("rSig in another form than x-only"));
            }
            found => {
                let field = "rSig";
                return Err(Malformed::Value { field, found }.into());
            }
        }
        let (r, s) = (reader.array("rSig")?, reader.array("sSig")?);
        let signature = ecdsa::Signature::from_scalars(r, s);
        let field = "signature";
        Ok(Self(
            signature.map_err(|_| Malformed::NotOnCurve { field })?,
        ))
    }

    /// The octets of a `Signature`.
    pub(super) fn octets(&self) -> [u8; SIGNATURE_LEN] {
        let mut octets = [0; SIGNATURE_LEN];
        octets[0] = NIST_P256;
        octets[1] = X_ONLY;
        octets[2..].copy_from_slice(&self.0.to_bytes());
        octets
    }

    /// `rSig` and `sSig`.
    pub(super) fn numbers(&self) -> ([u8; 32], [u8; 32]) {
        let (r, s) = self.0.split_bytes();
        (r.into(), s.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_survives_its_file_and_prints_as_nothing() {
        let key = PrivateKey::generate();
        let pem = key.to_pem().unwrap();
        let again = PrivateKey::of_pem(pem.as_ref()).unwrap();
        assert_eq!(again.public_key(), key.public_key());
        assert_eq!(format!("{key:?}"), "PrivateKey");
        assert_eq!(PrivateKey::of_pem("no key").unwrap_err(), NoKey);
        assert_eq!(PrivateKey::of_octets(&[0; 32]).unwrap_err(), NoKey);
    }

    #[test]
    fn a_signature_fits_one_key_and_one_digest() {
        let key = PrivateKey::of_octets(&[1; 32]).unwrap();
        let other = PrivateKey::of_octets(&[2; 32]).unwrap();
        let digest = to_be_signed(b"data", None);
        let signature = key.sign(&digest);
        assert!(key.public_key().verifies(&digest, &signature));
        assert!(!other.public_key().verifies(&digest, &signature));
        let digest = to_be_signed(b"date", None);
        assert!(!key.public_key().verifies(&digest, &signature));
    }

    #[test]
    fn what_is_on_no_curve_is_no_key_and_no_signature() {
        let mut point = [COMPRESSED_Y_0; 33];
        let found = (0..=255).filter(|x| {
            point[1..].fill(*x);
            PublicKey::read(&mut OerReader::new(&point), "key").is_ok()
        });
        let found = found.count();
        assert!((64..192).contains(&found), "{found} of 256");
        for number in [0, 0xff] {
            let mut octets = [number; SIGNATURE_LEN];
            octets[..2].fill(0x80);
            let signature = Signature::read(&mut OerReader::new(&octets));
            let field = "signature";
            assert_eq!(signature, Err(Malformed::NotOnCurve { field }.into()));
        }
    }
}
