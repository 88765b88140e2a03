//! The envelope: `Ieee1609Dot2Data` with signed data (IEEE 1609.2, clause 6.3; TS 103 097, clauses
//! 5.1, 5.2 and 7.1).
//!
//! ```text
//!  03 81 00 │ 40 03 80 length payload │ header │ signer               │ signature
//!           └── what is signed: tbsData ───────┘ digest, or certificate
//! ```

use super::certificate::{Certificate, consumed, read_place};
use super::coer::{self, OerReader};
use super::crypto::{self, Digest, Signature};
use super::hashed_id::{HashedId3, HashedId8};
use super::region::Place;
use super::rejected::{Malformed, Rejected};
use super::time::Time64;

/// How many certificates this station asks for at once.
pub(super) const REQUESTS_MAX: usize = 4;
/// How many certificates the message of another station may ask for.
const REQUESTS_TAKEN_MAX: u32 = 32;
/// ITS-AID of cooperative awareness.
const CAM: u32 = 36;
/// ITS-AID of decentralized environmental notification.
const DENM: u32 = 37;

/// A message with a signature that has not been checked.
#[derive(Clone, Debug)]
pub struct SignedMessage<'a> {
    /// The signed octets: common header, extended header, BTP and message.
    pub payload: &'a [u8],
    /// Its header.
    pub header: Header<'a>,
    /// Its signer.
    pub signer: SignerIdentifier,
    to_be_signed: Digest,
    signature: Signature,
}

/// The header of a signed message (`HeaderInfo`).
#[derive(Clone, Debug)]
pub struct Header<'a> {
    /// The permission under which it is sent (`psid`).
    pub its_aid: u32,
    /// When it was generated.
    pub generation_time: Time64,
    /// When it is over.
    pub expiry_time: Option<Time64>,
    /// Where it was generated.
    pub generation_location: Option<Place>,
    /// Of which certificates its sender asks for the whole, three octets each.
    requests: &'a [u8],
    /// The certificate of an authority that somebody asked for.
    pub(super) requested_certificate: Option<&'a [u8]>,
}

/// Signer of a message.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum SignerIdentifier {
    /// The holder of this certificate.
    Digest(HashedId8),
    /// The holder of the certificate that comes with it.
    Certificate(Box<Certificate>),
}

impl Header<'_> {
    /// Of which certificates its sender asks for the whole (`inlineP2pcdRequest`).
    pub fn requests(&self) -> impl Iterator<Item = HashedId3> {
        let (ids, _) = self.requests.as_chunks();
        ids.iter().copied().map(HashedId3)
    }
}

impl SignerIdentifier {
    /// The name of the signer's certificate.
    #[must_use]
    pub fn id(&self) -> HashedId8 {
        match self {
            Self::Digest(id) => *id,
            Self::Certificate(certificate) => certificate.id(),
        }
    }
}

impl<'a> SignedMessage<'a> {
    /// Reads an envelope, which must be all of the octets.
    ///
    /// # Errors
    /// Why they are not one, or one that is not taken.
    pub fn decode(octets: &'a [u8]) -> Result<Self, Rejected> {
        let mut reader = OerReader::new(octets);
        let reader = &mut reader;
        reader.expect(3, "protocolVersion")?;
        match reader.octet("content")? {
            0x81 => {}
            0x80 | 0x82..=0x84 => return Err(Rejected::NotSigned),
            found => {
                let field = "content";
                return Err(Malformed::Value { field, found }.into());
            }
        }
        match reader.octet("hashId")? {
            0 => {}
            _ => return Err(Rejected::Unsupported("a hash other than SHA-256")),
        }
        let before = reader.rest();
        let payload = read_payload(reader)?;
        let header = Header::read(reader)?;
        let to_be_signed = consumed(before, reader);
        let message = Self {
            payload,
            header,
            signer: read_signer(reader)?,
            to_be_signed: crypto::sha256(to_be_signed),
            signature: Signature::read(reader)?,
        };
        reader.finish("signature")?;
        message.check_profile()?;
        Ok(message)
    }

    /// Checks a service's header by TS 103 097, clause 7.1.
    fn check_profile(&self) -> Result<(), Rejected> {
        let header = &self.header;
        let against = match header.its_aid {
            CAM | DENM if header.expiry_time.is_some() => "expiryTime",
            CAM if header.generation_location.is_some() => "generationLocation",
            DENM if header.generation_location.is_none() => "no generationLocation",
            DENM if matches!(self.signer, SignerIdentifier::Digest(_)) => "a digest as signer",
            _ => return self.check_expiry(),
        };
        Err(Rejected::AgainstProfile(against))
    }

    fn check_expiry(&self) -> Result<(), Rejected> {
        match self.header.expiry_time {
            Some(expiry) if expiry <= self.header.generation_time => {
                Err(Rejected::ExpiresBeforeGenerated)
            }
            _ => Ok(()),
        }
    }

    /// The digest of what is signed.
    pub(super) const fn to_be_signed(&self) -> &Digest {
        &self.to_be_signed
    }

    /// A number that tells this message, as it is signed, from every other one.
    pub(super) fn fingerprint(&self) -> Digest {
        let [signer, signature] = [&self.signer.id().0[..], &self.signature.octets()];
        crypto::sha256(&[&self.to_be_signed, signer, signature].concat())
    }

    pub(super) fn is_signed_by(&self, certificate: &Certificate) -> bool {
        let (data, signer) = (&self.to_be_signed, certificate.digest());
        let point = certificate.point();
        point.is_some_and(|point| point.verifies(data, signer, &self.signature))
    }
}

impl Header<'_> {
    /// Checks the profile of RAM and RMCM, which is the one of CAM (TS 103 097, clause 7.1.1).
    ///
    /// # Errors
    /// The field that must not be there.
    pub fn check_robot_profile(&self) -> Result<(), Rejected> {
        if self.expiry_time.is_some() {
            return Err(Rejected::ExpiryNotAllowed);
        }
        if self.generation_location.is_some() {
            return Err(Rejected::LocationNotAllowed);
        }
        Ok(())
    }
}

fn read_payload<'a>(reader: &mut OerReader<'a>) -> Result<&'a [u8], Rejected> {
    match reader.octet("payload")? {
        0x40 => {}
        _ => return Err(Rejected::Unsupported("a payload but data alone")),
    }
    reader.expect(3, "payload.protocolVersion")?;
    match reader.octet("payload.content")? {
        0x80 => Ok(reader.opaque("payload.unsecuredData")?),
        // Data that is signed twice would let decoders recurse.
        _ => Err(Rejected::Unsupported("a payload that is secured itself")),
    }
}

/// Bits of the preamble of `HeaderInfo`.
mod present {
    pub(super) const ADDITIONS: u8 = 0x80;
    pub(super) const GENERATION_TIME: u8 = 0x40;
    pub(super) const EXPIRY_TIME: u8 = 0x20;
    pub(super) const GENERATION_LOCATION: u8 = 0x10;
    pub(super) const LEARNING_REQUEST: u8 = 0x08;
    pub(super) const MISSING_CRL: u8 = 0x04;
    pub(super) const ENCRYPTION_KEY: u8 = 0x02;
    pub(super) const UNUSED: u8 = 0x01;
}

impl<'a> Header<'a> {
    fn read(reader: &mut OerReader<'a>) -> Result<Self, Rejected> {
        let preamble = reader.octet("headerInfo")?;
        let has = |bit| preamble & bit != 0;
        if has(present::UNUSED) {
            let (field, found) = ("headerInfo", preamble);
            return Err(Malformed::Value { field, found }.into());
        }
        for (bit, field) in [
            (present::LEARNING_REQUEST, "p2pcdLearningRequest"),
            (present::MISSING_CRL, "missingCrlIdentifier"),
            (present::ENCRYPTION_KEY, "encryptionKey"),
        ] {
            if has(bit) {
                return Err(Rejected::AgainstProfile(field));
            }
        }
        if !has(present::GENERATION_TIME) {
            return Err(Rejected::AgainstProfile("no generationTime"));
        }
        let its_aid = reader.unsigned("psid")?;
        let generation_time = Time64(reader.u64("generationTime")?);
        let expiry_time = has(present::EXPIRY_TIME).then(|| reader.u64("expiryTime"));
        let expiry_time = expiry_time.transpose()?.map(Time64);
        let location = has(present::GENERATION_LOCATION).then(|| read_location(reader));
        let generation_location = location.transpose()?;
        let [requests, requested_certificate, functional_type] = if has(present::ADDITIONS) {
            reader.additions("headerInfo")?
        } else {
            [None; 3]
        };
        if functional_type.is_some() {
            return Err(Rejected::OtherProtocol);
        }
        Ok(Self {
            its_aid,
            generation_time,
            expiry_time,
            generation_location,
            requests: requests.map_or(Ok(&[][..]), read_requests)?,
            requested_certificate,
        })
    }

    /// Appends a header. `requests` are certificates to ask for, `certificate` one that was asked
    /// for.
    pub(super) fn put(
        its_aid: u32,
        generation_time: Time64,
        requests: &[HashedId3],
        certificate: Option<&Certificate>,
        to: &mut Vec<u8>,
    ) {
        let has_additions = !requests.is_empty() || certificate.is_some();
        let additions = if has_additions { present::ADDITIONS } else { 0 };
        to.push(additions | present::GENERATION_TIME);
        coer::put_unsigned(its_aid, to);
        to.extend(generation_time.0.to_be_bytes());
        if !has_additions {
            return;
        }
        let bit = |is_set: bool, bit| if is_set { bit } else { 0 };
        let bitmap = bit(!requests.is_empty(), 0x80) | bit(certificate.is_some(), 0x40);
        // HeaderInfo has four additions since IEEE 1609.2-2022.
        to.extend([2, 4, bitmap]);
        if !requests.is_empty() {
            coer::put_length(2 + requests.len() * 3, to);
            coer::put_unsigned(u32::try_from(requests.len()).unwrap_or(0), to);
            to.extend(requests.iter().flat_map(|id| id.0));
        }
        if let Some(certificate) = certificate {
            coer::put_length(certificate.octets().len(), to);
            to.extend(certificate.octets());
        }
    }
}

fn read_location(reader: &mut OerReader) -> Result<Place, Rejected> {
    let place = read_place(reader, "generationLocation")?;
    reader.take(2, "elevation")?;
    Ok(place)
}

/// The octets of the ids that are asked for.
fn read_requests(content: &[u8]) -> Result<&[u8], Malformed> {
    let field = "inlineP2pcdRequest";
    let mut reader = OerReader::new(content);
    let quantity = reader.quantity(REQUESTS_TAKEN_MAX, field)?;
    let ids = reader.take(quantity as usize * 3, field)?;
    reader.finish(field)?;
    Ok(ids)
}

fn read_signer(reader: &mut OerReader) -> Result<SignerIdentifier, Rejected> {
    let field = "signer";
    match reader.octet(field)? {
        0x80 => Ok(SignerIdentifier::Digest(HashedId8(reader.array(field)?))),
        0x81 => match reader.quantity(u32::MAX, field)? {
            1 => Ok(SignerIdentifier::Certificate(Box::new(Certificate::read(
                reader,
            )?))),
            _ => Err(Rejected::AgainstProfile("not exactly one certificate")),
        },
        0x82 => Err(Rejected::AgainstProfile("self as signer")),
        found => Err(Malformed::Value { field, found }.into()),
    }
}

/// Appends the part of an envelope that stands before its header.
pub(super) fn put_payload(payload: &[u8], to: &mut Vec<u8>) {
    to.extend([0x40, 3, 0x80]);
    coer::put_length(payload.len(), to);
    to.extend_from_slice(payload);
}

/// The version, content and hash in front of what is signed.
pub(super) const HEAD: [u8; 3] = [3, 0x81, 0];

/// Appends the signer.
pub(super) fn put_signer(certificate: &Certificate, in_full: bool, to: &mut Vec<u8>) {
    if in_full {
        to.extend([0x81, 1, 1]);
        to.extend(certificate.octets());
    } else {
        to.push(0x80);
        to.extend(certificate.id().0);
    }
}
