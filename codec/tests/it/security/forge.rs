//! Certificates and envelopes octet by octet, also such as must not be: nothing of the kit encodes or signs here.
#![allow(
    clippy::cast_possible_truncation,
    reason = "lengths are split into octets"
)]

use p256::ecdsa::signature::hazmat::PrehashSigner;
use p256::ecdsa::{Signature, SigningKey};
use sha2::{Digest, Sha256};

/// The key of this number.
pub(crate) fn key(number: u8) -> SigningKey {
    SigningKey::from_slice(&[number; 32]).unwrap()
}

/// IEEE 1609.2, clause 5.3.1: what is signed is the digest of both digests.
pub(crate) fn sign(key: &SigningKey, data: &[u8], signer: &[u8]) -> Vec<u8> {
    let both = [Sha256::digest(data), Sha256::digest(signer)].concat();
    let signature: Signature = key.sign_prehash(&Sha256::digest(both)).unwrap();
    [&[0x80, 0x80][..], &signature.to_bytes()].concat()
}

/// The last eight octets of a certificate's digest.
pub(crate) fn hashed_id8(certificate: &[u8]) -> Vec<u8> {
    Sha256::digest(certificate)[24..].to_vec()
}

/// A length of an open type or OCTET STRING, and its octets.
pub(crate) fn opaque(octets: &[u8]) -> Vec<u8> {
    let length = octets.len();
    let head = match length {
        0..0x80 => vec![length as u8],
        0x80..0x100 => vec![0x81, length as u8],
        _ => vec![0x82, (length >> 8) as u8, length as u8],
    };
    [head.as_slice(), octets].concat()
}

/// An ITS-AID as its COER integer.
pub(crate) fn psid(its_aid: u32) -> Vec<u8> {
    let octets = its_aid.to_be_bytes();
    let first = octets.iter().position(|octet| *octet != 0).unwrap_or(3);
    opaque(&octets[first..])
}

/// A latitude and a longitude.
pub(crate) fn location((latitude, longitude): (i32, i32)) -> Vec<u8> {
    [latitude.to_be_bytes(), longitude.to_be_bytes()].concat()
}

/// `SEQUENCE OF PsidSsp`, each with the bitmap of its service.
pub(crate) fn permissions(its_aids: &[u32]) -> Vec<u8> {
    let mut octets = vec![1, its_aids.len() as u8];
    for its_aid in its_aids {
        let bitmap = opaque(&[1, 0xc0]);
        octets.push(0x80);
        octets.extend(psid(*its_aid));
        octets.push(0x81);
        octets.extend(opaque(&bitmap));
    }
    octets
}

/// `SEQUENCE OF PsidGroupPermissions` with one for these services: `head` is its preamble, `tail` what follows the
/// services.
pub(crate) fn issue_permissions(head: u8, its_aids: &[u32], tail: &[u8]) -> Vec<u8> {
    let mut octets = vec![1, 1, head, 0x80, 1, its_aids.len() as u8];
    for its_aid in its_aids {
        octets.push(0x80);
        octets.extend(psid(*its_aid));
        octets.push(0x81);
    }
    [&octets[..], tail].concat()
}

/// `ToBeSignedCertificate`, part by part.
#[derive(Clone)]
pub(crate) struct Terms {
    pub(crate) name: Option<&'static str>,
    pub(crate) start: u32,
    pub(crate) hours: u16,
    /// Which alternative of `Duration`: 4 for hours.
    pub(crate) unit: u8,
    /// `GeographicRegion`; nothing where there is none.
    pub(crate) region: Vec<u8>,
    pub(crate) permissions: Vec<u8>,
    pub(crate) issue: Vec<u8>,
    /// `assuranceLevel`; nothing where there is none.
    pub(crate) assurance: Vec<u8>,
    /// The algorithms of `encryptionKey`, which is that of the receiver; nothing where there is none.
    pub(crate) encryption: Vec<u8>,
    /// The bitmap of additions and what follows it; nothing where there are none.
    pub(crate) additions: Vec<u8>,
    pub(crate) key: u8,
}

/// The public key of this number, as a compressed point or as one with both coordinates.
fn point(number: u8, is_compressed: bool) -> Vec<u8> {
    let point = key(number).verifying_key().to_sec1_point(is_compressed);
    [&[0x80 | point.as_bytes()[0]], &point.as_bytes()[1..]].concat()
}

impl Terms {
    fn octets(&self, is_compressed: bool) -> Vec<u8> {
        let bit = |part: &[u8], bit: u8| if part.is_empty() { 0 } else { bit };
        let mut octets = vec![
            bit(&self.additions, 0x80)
                | bit(&self.region, 0x40)
                | bit(&self.assurance, 0x20)
                | bit(&self.permissions, 0x10)
                | bit(&self.issue, 0x08)
                | bit(&self.encryption, 0x01),
        ];
        match self.name {
            Some(name) => {
                octets.push(0x81);
                octets.extend(opaque(name.as_bytes()));
            }
            None => octets.push(0x83),
        }
        octets.extend([0; 5]);
        octets.extend(self.start.to_be_bytes());
        octets.push(0x80 | self.unit);
        octets.extend(self.hours.to_be_bytes());
        octets.extend(&self.region);
        octets.extend(&self.assurance);
        octets.extend(&self.permissions);
        octets.extend(&self.issue);
        if !self.encryption.is_empty() {
            octets.extend(&self.encryption);
            octets.extend(point(11, is_compressed));
        }
        octets.extend([0x80, 0x80]);
        octets.extend(point(self.key, is_compressed));
        octets.extend(&self.additions);
        octets
    }

    /// The certificate, signed by `issuer` with the key of this number; by itself without one.
    pub(crate) fn signed(&self, issuer: Option<&[u8]>, by: u8) -> Vec<u8> {
        self.sent(issuer, by, true)
    }

    /// The same, sent with points in this form. What is signed has compressed ones (IEEE 1609.2, 6.4.8).
    pub(crate) fn sent(&self, issuer: Option<&[u8]>, by: u8, is_compressed: bool) -> Vec<u8> {
        let to_be_signed = self.octets(true);
        let mut octets = vec![0x80, 3, 0];
        match issuer {
            Some(issuer) => {
                octets.push(0x80);
                octets.extend(hashed_id8(issuer));
            }
            None => octets.extend([0x81, 0]),
        }
        octets.extend(self.octets(is_compressed));
        octets.extend(sign(&key(by), &to_be_signed, issuer.unwrap_or_default()));
        octets
    }
}

/// An envelope, part by part.
#[derive(Clone)]
pub(crate) struct Envelope {
    pub(crate) payload: Vec<u8>,
    /// Bits of the preamble of `HeaderInfo` besides that of `generationTime`.
    pub(crate) preamble: u8,
    pub(crate) its_aid: u32,
    pub(crate) generated_us: u64,
    /// `expiryTime`, `generationLocation`.
    pub(crate) fields: Vec<u8>,
    /// The bitmap of additions and what follows it.
    pub(crate) additions: Vec<u8>,
    /// In canonical form.
    pub(crate) certificate: Vec<u8>,
    /// As it goes along; nothing where its digest does.
    pub(crate) sent: Vec<u8>,
    pub(crate) key: u8,
    /// Which alternative of `EccP256CurvePoint` `rSig` is.
    pub(crate) r_form: u8,
}

/// The same octets, which end with a signature, with another alternative for its `rSig`. Nobody looks at y.
pub(crate) fn with_r_form(mut octets: Vec<u8>, form: u8) -> Vec<u8> {
    let at = octets.len() - 65;
    octets[at] = form;
    if form == 0x84 {
        let s = octets.split_off(at + 33);
        octets.extend([0x55; 32]);
        octets.extend(s);
    }
    octets
}

/// The same octets, which end with a signature, with n - s for its s.
pub(crate) fn mirrored(mut octets: Vec<u8>) -> Vec<u8> {
    let at = octets.len() - 64;
    let (r, s) = Signature::from_slice(&octets[at..])
        .unwrap()
        .split_scalars();
    let mirrored = Signature::from_scalars(r, -s).unwrap();
    octets[at..].copy_from_slice(&mirrored.to_bytes());
    octets
}

impl Envelope {
    pub(crate) fn octets(&self) -> Vec<u8> {
        let mut signed = vec![0x40, 3, 0x80];
        signed.extend(opaque(&self.payload));
        let additions = if self.additions.is_empty() { 0 } else { 0x80 };
        signed.push(0x40 | self.preamble | additions);
        signed.extend(psid(self.its_aid));
        signed.extend(self.generated_us.to_be_bytes());
        signed.extend(&self.fields);
        signed.extend(&self.additions);
        let mut octets = [&[3, 0x81, 0][..], &signed].concat();
        if self.sent.is_empty() {
            octets.push(0x80);
            octets.extend(hashed_id8(&self.certificate));
        } else {
            octets.extend([0x81, 1, 1]);
            octets.extend(&self.sent);
        }
        octets.extend(sign(&key(self.key), &signed, &self.certificate));
        with_r_form(octets, self.r_form)
    }
}
