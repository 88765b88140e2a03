//! SHA-256 and ECDSA over NIST P-256, as IEEE 1609.2 composes them (clause 5.3.1).
//!
//! Two libraries share the work. `ring` verifies, since a robot verifies what everybody around it sends, and it is
//! more than twice as fast. `p256` signs, since its signatures are those of RFC 6979: the same message and key give the
//! same signature, so that runs repeat and nothing depends on random numbers. The tests hold the two against each other.

use std::fmt;

use p256::ecdsa::signature::hazmat::PrehashSigner;
use p256::ecdsa::{self, SigningKey, VerifyingKey};
use p256::elliptic_curve::Generate;
use p256::elliptic_curve::sec1::ToSec1Point as _;
use p256::pkcs8::{DecodePrivateKey, EncodePrivateKey, LineEnding};
use ring::signature::{ECDSA_P256_SHA256_FIXED, UnparsedPublicKey};

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
const UNCOMPRESSED: u8 = 0x84;

pub(super) fn sha256(octets: &[u8]) -> Digest {
    use p256::ecdsa::signature::digest::Digest as _;
    sha2::Sha256::digest(octets).into()
}

/// The digest that is signed: of the data's digest and of the signer's certificate's, which is the
/// empty string for who signs for itself.
pub(super) fn to_be_signed(data: &[u8], signer: Option<&Digest>) -> Digest {
    let signer = signer.copied().unwrap_or_else(|| sha256(&[]));
    sha256(&both(&sha256(data), &signer))
}

/// The octets of both digests. Their digest is what is signed.
fn both(data: &Digest, signer: &Digest) -> [u8; 64] {
    let mut octets = [0; 64];
    octets[..32].copy_from_slice(data);
    octets[32..].copy_from_slice(signer);
    octets
}

/// A private key. It prints as nothing, and is wiped from memory when it is dropped.
#[derive(Clone)]
pub struct PrivateKey(SigningKey);

/// A public key as it is written: the parity of y, and x. Whether there is such a point on the curve costs as much to find
/// out as a third of a signature, so that is left to the first signature that is checked with it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PublicKey([u8; 33]);

/// A public key that is a point on the curve, with both coordinates.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Verifying([u8; 65]);

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
        PublicKey::compressed(self.0.verifying_key())
    }

    /// Signs a digest. The same key and digest give the same signature (RFC 6979).
    pub(super) fn sign(&self, digest: &Digest) -> Signature {
        let signature = self.0.sign_prehash(digest);
        Signature(signature.expect("a digest of 256 bits can be signed"))
    }
}

impl PublicKey {
    /// The key in an uncompressed or compressed point of SEC 1, as tokens tell it; `None` where there is none.
    #[must_use]
    pub fn of_sec1(octets: &[u8]) -> Option<Self> {
        let key = VerifyingKey::from_sec1_bytes(octets).ok()?;
        Some(Self::compressed(&key))
    }

    fn compressed(key: &VerifyingKey) -> Self {
        let mut octets = [0; 33];
        octets.copy_from_slice(key.as_affine().to_sec1_point(true).as_bytes());
        Self(octets)
    }

    /// Reads an `EccP256CurvePoint` with both coordinates, or with x and the parity of y.
    pub(super) fn read(reader: &mut OerReader, field: &'static str) -> Result<Self, Malformed> {
        let form = reader.octet(field)?;
        let mut point = [0; 33];
        point[1..].copy_from_slice(&reader.array::<32>(field)?);
        point[0] = match form {
            COMPRESSED_Y_0 => 2,
            COMPRESSED_Y_1 => 3,
            UNCOMPRESSED => 2 | reader.array::<32>(field)?[31] & 1,
            found => return Err(Malformed::Value { field, found }),
        };
        Ok(Self(point))
    }

    /// The octets of an `EccP256CurvePoint` in compressed form, the canonical one.
    pub(super) const fn octets(&self) -> [u8; 33] {
        let mut octets = self.0;
        octets[0] |= 0x80;
        octets
    }

    /// True if y is odd, and the x coordinate.
    #[cfg(feature = "issue")]
    pub(super) fn coordinates(&self) -> (bool, [u8; 32]) {
        let mut x = [0; 32];
        x.copy_from_slice(&self.0[1..]);
        (self.0[0] == 3, x)
    }
}

impl Verifying {
    /// The point of a key, if there is one.
    pub(super) fn of(key: &PublicKey) -> Option<Self> {
        let key = VerifyingKey::from_sec1_bytes(&key.0).ok()?;
        let mut octets = [0; 65];
        octets.copy_from_slice(key.as_affine().to_sec1_point(false).as_bytes());
        Some(Self(octets))
    }

    /// True if the holder of the key has signed data with this digest, as the holder of the certificate with that
    /// digest.
    pub(super) fn verifies(&self, data: &Digest, signer: &Digest, signature: &Signature) -> bool {
        let key = UnparsedPublicKey::new(&ECDSA_P256_SHA256_FIXED, &self.0);
        key.verify(&both(data, signer), &signature.0.to_bytes())
            .is_ok()
    }
}

impl Signature {
    /// The signature of r and s, 32 octets each, big-endian, as tokens tell it; `None` where they are out of range.
    #[must_use]
    pub fn of_octets(octets: &[u8; 64]) -> Option<Self> {
        ecdsa::Signature::from_slice(octets).map(Self).ok()
    }

    /// Reads a `Signature`, whose `rSig` may be x alone or a point (IEEE 1609.2, 6.3.29). What is said of y only saves
    /// time to a verifier that makes use of it, and no signature covers it: it is dropped.
    pub(super) fn read(reader: &mut OerReader) -> Result<Self, Rejected> {
        match reader.octet("signature")? {
            NIST_P256 => {}
            0x81..=0x84 => return Err(Rejected::Unsupported("a curve other than NIST P-256")),
            found => {
                let field = "signature";
                return Err(Malformed::Value { field, found }.into());
            }
        }
        let y_len = match reader.octet("rSig")? {
            X_ONLY | COMPRESSED_Y_0 | COMPRESSED_Y_1 => 0,
            UNCOMPRESSED => 32,
            found => {
                let field = "rSig";
                return Err(Malformed::Value { field, found }.into());
            }
        };
        let r = reader.array("rSig")?;
        reader.take(y_len, "rSig")?;
        let s = reader.array("sSig")?;
        let signature = ecdsa::Signature::from_scalars(r, s);
        Ok(Self(
            signature.map_err(|_| Malformed::NotOnCurve("signature"))?,
        ))
    }

    /// The other signature that is right wherever this one is: with n - s in the place of s.
    pub(super) fn mirrored(&self) -> Self {
        let (r, s) = self.0.split_scalars();
        ecdsa::Signature::from_scalars(r.to_bytes(), (-*s).to_bytes()).map_or(*self, Self)
    }

    /// This one or its mirror, whichever has the lower s.
    pub(super) fn low(&self) -> Self {
        Self(self.0.normalize_s())
    }

    /// The octets of a `Signature` in canonical form, with x alone.
    pub(super) fn octets(&self) -> [u8; SIGNATURE_LEN] {
        let mut octets = [0; SIGNATURE_LEN];
        octets[0] = NIST_P256;
        octets[1] = X_ONLY;
        octets[2..].copy_from_slice(&self.0.to_bytes());
        octets
    }

    /// `rSig` and `sSig`.
    #[cfg(feature = "issue")]
    pub(super) fn numbers(&self) -> ([u8; 32], [u8; 32]) {
        let (r, s) = self.0.split_bytes();
        (r.into(), s.into())
    }
}

/// 32 octets that nobody can guess.
#[must_use]
pub fn random_octets() -> [u8; 32] {
    sha256(&PrivateKey::generate().0.to_bytes())
}

/// 32 octets that follow from others, and that nobody can guess who does not know the key.
#[must_use]
pub fn keyed_digest(key: &[u8; 32], octets: &[u8]) -> [u8; 32] {
    // Two digests, so that nobody can go on from a shorter text to a longer one.
    sha256(&[&key[..], &sha256(&[&key[..], octets].concat())].concat())
}

#[cfg(test)]
mod tests {
    use p256::ecdsa::signature::hazmat::PrehashVerifier;
    use proptest::prelude::*;

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

    fn verifying(key: &PrivateKey) -> Verifying {
        Verifying::of(&key.public_key()).unwrap()
    }

    /// Wiped from memory when dropped: the compiler holds that, here.
    #[test]
    fn a_private_key_is_wiped_when_it_is_dropped() {
        fn is_wiped<T: p256::elliptic_curve::zeroize::ZeroizeOnDrop>(_: &T) {}
        is_wiped(&PrivateKey::generate().0);
    }

    #[test]
    fn a_signature_fits_one_key_one_text_and_one_signer() {
        let key = PrivateKey::of_octets(&[1; 32]).unwrap();
        let other = PrivateKey::of_octets(&[2; 32]).unwrap();
        let (data, nobody) = (sha256(b"data"), sha256(&[]));
        let signature = key.sign(&to_be_signed(b"data", None));
        assert!(verifying(&key).verifies(&data, &nobody, &signature));
        assert!(!verifying(&other).verifies(&data, &nobody, &signature));
        assert!(!verifying(&key).verifies(&sha256(b"date"), &nobody, &signature));
        assert!(!verifying(&key).verifies(&data, &data, &signature));
    }

    /// The verdict of the other library, which signs.
    fn judged(key: &PrivateKey, data: &Digest, signer: &Digest, signature: &Signature) -> bool {
        let digest = sha256(&both(data, signer));
        let key = key.0.verifying_key();
        key.verify_prehash(&digest, &signature.0).is_ok()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(256))]

        #[test]
        fn both_libraries_agree(
            secret in prop::array::uniform32(1_u8..),
            data in prop::array::uniform32(any::<u8>()),
            signer in prop::array::uniform32(any::<u8>()),
            flipped in prop::option::of(0..512_usize),
        ) {
            // Every octet is at least 1 and the first at most 0x7f: below the order of the curve.
            let mut secret = secret;
            secret[0] &= 0x7f;
            let key = PrivateKey::of_octets(&secret).unwrap();
            let signature = key.sign(&sha256(&both(&data, &signer)));
            prop_assert!(verifying(&key).verifies(&data, &signer, &signature));
            prop_assert!(judged(&key, &data, &signer, &signature));
            let mut octets = signature.octets();
            if let Some(bit) = flipped {
                octets[2 + bit / 8] ^= 0x80 >> (bit % 8);
            }
            let Ok(changed) = Signature::read(&mut OerReader::new(&octets)) else {
                return Ok(());
            };
            let is_good = verifying(&key).verifies(&data, &signer, &changed);
            prop_assert_eq!(is_good, judged(&key, &data, &signer, &changed));
            prop_assert_eq!(is_good, flipped.is_none());
            // The other number that fits as well: neither library refuses it, and replays are told by what is signed.
            let (r, s) = signature.0.split_scalars();
            let mirrored = Signature(ecdsa::Signature::from_scalars(r, -s).unwrap());
            prop_assert!(verifying(&key).verifies(&data, &signer, &mirrored));
            prop_assert!(judged(&key, &data, &signer, &mirrored));
        }
    }

    #[test]
    fn what_is_on_no_curve_is_no_key_and_no_signature() {
        let mut point = [2; 33];
        let found = (0..=255).filter(|x| {
            point[1..].fill(*x);
            Verifying::of(&PublicKey(point)).is_some()
        });
        let found = found.count();
        assert!((64..192).contains(&found), "{found} of 256");
        for number in [0, 0xff] {
            let mut octets = [number; SIGNATURE_LEN];
            octets[..2].fill(0x80);
            let signature = Signature::read(&mut OerReader::new(&octets));
            assert_eq!(signature, Err(Malformed::NotOnCurve("signature").into()));
        }
    }
}
