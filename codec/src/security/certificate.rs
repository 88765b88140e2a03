//! Certificates (IEEE 1609.2, clause 6.4; TS 103 097, clauses 6 and 7.2).

use std::collections::BTreeSet;
use std::sync::OnceLock;

use super::coer::OerReader;

use super::crypto::{self, Digest, PublicKey, SIGNATURE_LEN, Signature, Verifying};
use super::hashed_id::HashedId8;
use super::permissions::{IssuePermission, Permission, Ssp, SspRange, Subjects};
use super::region::{Place, Region};
use super::rejected::{Malformed, Rejected};
use super::time::{Duration, Unit, Validity};

/// The longest certificate that is taken, in octets. One that comes with a message is far below.
pub const CERTIFICATE_LEN_MAX: usize = 1_024;
/// How many permissions, regions and the like a certificate may list.
const LIST_MAX: u32 = 32;

/// Issuer of a certificate.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Issuer {
    /// The holder of this certificate.
    Certificate(HashedId8),
    /// Itself: a root.
    Itself,
}

/// A certificate. Its octets are in canonical form, whatever form was read. Nothing is said of whether it can be trusted.
#[derive(Clone, Debug)]
pub struct Certificate {
    octets: Box<[u8]>,
    digest: Digest,
    to_be_signed: Digest,
    signature: Signature,
    content: Content,
    /// The point of its key; `None` in it, if there is no such point on the curve.
    point: OnceLock<Option<Verifying>>,
    /// The name of its mirror, in which n - s stands in the place of s.
    mirror: OnceLock<HashedId8>,
}

impl PartialEq for Certificate {
    /// Everything else follows from the octets.
    fn eq(&self, other: &Self) -> bool {
        self.octets == other.octets
    }
}

impl Eq for Certificate {}

/// Content of a certificate.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Content {
    /// Its issuer.
    pub issuer: Issuer,
    /// Its name; pseudonym tickets have none.
    pub name: Option<String>,
    /// When it is valid.
    pub validity: Validity,
    /// Where it is valid; anywhere, if that is not said.
    pub region: Option<Region>,
    /// Permissions of its holder to send messages.
    pub permissions: Vec<Permission>,
    /// Permissions of its holder to issue certificates.
    pub issue_permissions: Vec<IssuePermission>,
    /// The key of its holder.
    pub key: PublicKey,
}

impl Certificate {
    /// Reads a certificate, which must be all of the octets.
    ///
    /// # Errors
    /// Why they are not one, or one that the kit does not support.
    pub fn decode(octets: &[u8]) -> Result<Self, Rejected> {
        let mut reader = OerReader::new(octets);
        let certificate = Self::read(&mut reader)?;
        reader.finish("certificate")?;
        Ok(certificate)
    }

    pub(super) fn read(reader: &mut OerReader) -> Result<Self, Rejected> {
        let all = reader.rest();
        let value = |field, found| Malformed::Value { field, found };
        match reader.octet("certificate")? {
            0x80 => {}
            // Without a signature.
            0 => return Err(Rejected::Unsupported("an implicit certificate")),
            found => return Err(value("certificate", found).into()),
        }
        reader.expect(3, "certificate.version")?;
        match reader.octet("certificate.type")? {
            0 => {}
            1 => return Err(Rejected::Unsupported("an implicit certificate")),
            found => return Err(value("certificate.type", found).into()),
        }
        let issuer = read_issuer(reader)?;
        let head = all.len() - reader.rest().len();
        let mut canonical = Canonical::new(all);
        let content = Content::read(reader, issuer, &mut canonical)?;
        canonical.take(reader);
        let mut octets = canonical.octets;
        let to_be_signed = crypto::sha256(&octets[head..]);
        let signature = Signature::read(reader)?;
        octets.extend(signature.octets());
        if octets.len() > CERTIFICATE_LEN_MAX {
            return Err(Malformed::TooMany("certificate").into());
        }
        Ok(Self {
            digest: crypto::sha256(&octets),
            to_be_signed,
            octets: octets.into(),
            signature,
            content,
            point: OnceLock::new(),
            mirror: OnceLock::new(),
        })
    }

    /// Its octets.
    #[must_use]
    pub fn octets(&self) -> &[u8] {
        &self.octets
    }

    /// Its content.
    #[must_use]
    pub const fn content(&self) -> &Content {
        &self.content
    }

    /// Its name.
    #[must_use]
    pub const fn id(&self) -> HashedId8 {
        HashedId8::of(&self.digest)
    }

    /// The name of its holder: the id of the certificate or of its mirror, whichever has the lower s.
    ///
    /// A holder can put n - s in the place of s in the signature. The mirror is as valid as the certificate and has
    /// another id, so the id does not tell two holders apart.
    #[must_use]
    pub fn holder(&self) -> HashedId8 {
        if self.signature.low() == self.signature {
            self.id()
        } else {
            self.mirror()
        }
    }

    /// True if the certificate or its mirror is among these.
    #[must_use]
    pub fn is_among(&self, ids: &BTreeSet<HashedId8>) -> bool {
        !ids.is_empty() && (ids.contains(&self.id()) || ids.contains(&self.mirror()))
    }

    fn mirror(&self) -> HashedId8 {
        *self.mirror.get_or_init(|| {
            let signed = &self.octets[..self.octets.len() - SIGNATURE_LEN];
            let signature = self.signature.mirrored().octets();
            HashedId8::of(&crypto::sha256(&[signed, &signature].concat()))
        })
    }

    pub(super) const fn digest(&self) -> &Digest {
        &self.digest
    }

    /// The point that signatures of its holder are verified with; `None`, if its key is on no curve.
    pub(super) fn point(&self) -> Option<&Verifying> {
        let point = self.point.get_or_init(|| Verifying::of(&self.content.key));
        point.as_ref()
    }

    /// True if `issuer` signed it, or it itself.
    pub(super) fn is_signed_by(&self, issuer: Option<&Self>) -> bool {
        let above = issuer.map_or_else(|| crypto::sha256(&[]), |issuer| issuer.digest);
        let point = issuer.unwrap_or(self).point();
        point.is_some_and(|point| point.verifies(&self.to_be_signed, &above, &self.signature))
    }
}

/// A certificate in canonical form, as far as it was read. Its digest, and with it its name and signature, is that of
/// the form in which points are compressed and `rSig` is x alone (IEEE 1609.2, 6.4.3 and 6.4.8).
struct Canonical<'a> {
    octets: Vec<u8>,
    /// Octets that are not in `octets` yet.
    rest: &'a [u8],
}

impl<'a> Canonical<'a> {
    fn new(all: &'a [u8]) -> Self {
        Self {
            octets: Vec::with_capacity(all.len().min(CERTIFICATE_LEN_MAX)),
            rest: all,
        }
    }

    /// Takes what `reader` has read.
    fn take(&mut self, reader: &OerReader<'a>) {
        self.octets.extend(consumed(self.rest, reader));
        self.rest = reader.rest();
    }

    /// Reads a point.
    fn point(
        &mut self,
        reader: &mut OerReader<'a>,
        field: &'static str,
    ) -> Result<PublicKey, Malformed> {
        self.take(reader);
        let point = PublicKey::read(reader, field)?;
        self.octets.extend(point.octets());
        self.rest = reader.rest();
        Ok(point)
    }
}

/// Octets that `reader` has read since it was at `before`.
pub(super) fn consumed<'a>(before: &'a [u8], reader: &OerReader<'a>) -> &'a [u8] {
    &before[..before.len() - reader.rest().len()]
}

fn read_issuer(reader: &mut OerReader) -> Result<Issuer, Rejected> {
    let field = "certificate.issuer";
    match reader.octet(field)? {
        0x80 => Ok(Issuer::Certificate(HashedId8(reader.array(field)?))),
        0x81 => match reader.octet(field)? {
            0 => Ok(Issuer::Itself),
            _ => Err(Rejected::Unsupported("a hash other than SHA-256")),
        },
        0x82 | 0x83 => Err(Rejected::Unsupported("a hash other than SHA-256")),
        found => Err(Malformed::Value { field, found }.into()),
    }
}

/// Bits of the preamble of `ToBeSignedCertificate`.
mod present {
    pub(super) const ADDITIONS: u8 = 0x80;
    pub(super) const REGION: u8 = 0x40;
    pub(super) const ASSURANCE: u8 = 0x20;
    pub(super) const PERMISSIONS: u8 = 0x10;
    pub(super) const ISSUE: u8 = 0x08;
    pub(super) const REQUEST: u8 = 0x04;
    pub(super) const ROLLOVER: u8 = 0x02;
    pub(super) const ENCRYPTION: u8 = 0x01;
}

impl Content {
    fn read<'a>(
        reader: &mut OerReader<'a>,
        issuer: Issuer,
        canonical: &mut Canonical<'a>,
    ) -> Result<Self, Rejected> {
        let preamble = reader.octet("toBeSigned")?;
        let has = |bit| preamble & bit != 0;
        if has(present::REQUEST | present::ROLLOVER) {
            return Err(Rejected::AgainstProfile(
                "a certificate's request permissions",
            ));
        }
        if has(present::ADDITIONS) {
            return Err(Rejected::CertificateExtension);
        }
        let name = read_name(reader)?;
        reader.expect_zeros(5, "cracaId, crlSeries")?;
        let validity = read_validity(reader)?;
        let region = has(present::REGION).then(|| read_region(reader));
        let region = region.transpose()?;
        if has(present::ASSURANCE) {
            reader.octet("assuranceLevel")?;
        }
        let permissions = list(has(present::PERMISSIONS), reader, read_permission)?;
        let issue_permissions = list(has(present::ISSUE), reader, read_issue_permission)?;
        if has(present::ENCRYPTION) {
            skip_encryption_key(reader, canonical)?;
        }
        let key = read_verification_key(reader, canonical)?;
        Ok(Self {
            issuer,
            name,
            validity,
            region,
            permissions,
            issue_permissions,
            key,
        })
    }

    /// True if it is for pseudonyms: no name, and no certificates to issue.
    #[must_use]
    pub fn is_ticket(&self) -> bool {
        self.name.is_none() && self.issue_permissions.is_empty() && self.issuer != Issuer::Itself
    }
}

impl OerReader<'_> {
    fn expect_zeros(&mut self, length: usize, field: &'static str) -> Result<(), Malformed> {
        match self.take(length, field)?.iter().find(|octet| **octet != 0) {
            Some(&found) => Err(Malformed::Value { field, found }),
            None => Ok(()),
        }
    }
}

/// A SEQUENCE OF, empty if it is absent, but not if it is present.
fn list<T>(
    is_present: bool,
    reader: &mut OerReader,
    mut read: impl FnMut(&mut OerReader) -> Result<T, Rejected>,
) -> Result<Vec<T>, Rejected> {
    if !is_present {
        return Ok(Vec::new());
    }
    let quantity = reader.quantity(LIST_MAX, "toBeSigned")?;
    (0..quantity).map(|_| read(reader)).collect()
}

fn read_name(reader: &mut OerReader) -> Result<Option<String>, Rejected> {
    let field = "toBeSigned.id";
    match reader.octet(field)? {
        0x81 => {
            let name = std::str::from_utf8(reader.opaque(field)?);
            let name = name.map_err(|_| Malformed::NotCanonical(field))?;
            Ok(Some(name.to_owned()))
        }
        0x83 => Ok(None),
        0x80 | 0x82 => Err(Rejected::AgainstProfile(
            "a certificate id but name and none",
        )),
        found => Err(Malformed::Value { field, found }.into()),
    }
}

fn read_validity(reader: &mut OerReader) -> Result<Validity, Malformed> {
    let field = "validityPeriod";
    let start = reader.u32(field)?;
    let tag = reader.octet(field)?;
    let unit = tag
        .checked_sub(0x80)
        .and_then(|unit| Unit::ALL.get(usize::from(unit)))
        .ok_or(Malformed::Value { field, found: tag })?;
    let duration = Duration {
        number: reader.u16(field)?,
        unit: *unit,
    };
    Ok(Validity { start, duration })
}

/// A place on earth.
pub(super) fn read_place(reader: &mut OerReader, field: &'static str) -> Result<Place, Rejected> {
    let place = Place {
        latitude: reader.i32(field)?,
        longitude: reader.i32(field)?,
    };
    if place.is_on_earth() {
        Ok(place)
    } else {
        Err(Rejected::NotOnEarth(field))
    }
}

fn read_region(reader: &mut OerReader) -> Result<Region, Rejected> {
    let field = "region";
    match reader.octet(field)? {
        0x80 => Ok(Region::Circle {
            centre: read_place(reader, field)?,
            radius: reader.u16(field)?,
        }),
        0x81 => {
            let corner = |reader: &mut OerReader| read_place(reader, field);
            let corners = |reader: &mut OerReader| Ok((corner(reader)?, corner(reader)?));
            Ok(Region::Rectangles(list(true, reader, corners)?))
        }
        0x82 | 0x83 => Err(Rejected::Unsupported("a region but circles and rectangles")),
        found => Err(Malformed::Value { field, found }.into()),
    }
}

/// A preamble of which only the first bits are in use.
fn preamble(reader: &mut OerReader, used: u8, field: &'static str) -> Result<u8, Malformed> {
    match reader.octet(field)? {
        found if found & !used == 0 => Ok(found),
        found => Err(Malformed::Value { field, found }),
    }
}

fn read_permission(reader: &mut OerReader) -> Result<Permission, Rejected> {
    let field = "appPermissions";
    let has_ssp = preamble(reader, 0x80, field)? != 0;
    let its_aid = reader.unsigned("psid")?;
    let ssp = match has_ssp.then(|| reader.octet("ssp")).transpose()? {
        None => Ssp::Default,
        Some(0x80) => Ssp::Opaque(reader.opaque("ssp")?.to_vec()),
        Some(0x81) => {
            let mut inner = OerReader::new(reader.opaque("ssp")?);
            let bits = inner.opaque("bitmapSsp")?.to_vec();
            inner.finish("bitmapSsp")?;
            Ssp::Bitmap(bits)
        }
        Some(found) => return Err(Malformed::Value { field, found }.into()),
    };
    Ok(Permission { its_aid, ssp })
}

/// `app` of `EndEntityType`, which alone is the default.
const APPLICATIONS: u8 = 0x80;

fn read_issue_permission(reader: &mut OerReader) -> Result<IssuePermission, Rejected> {
    let field = "certIssuePermissions";
    let given = preamble(reader, 0xe0, field)?;
    let subjects = match reader.octet("subjectPermissions")? {
        0x80 => Subjects::These(list(true, reader, read_range)?),
        0x81 => Subjects::All,
        found => return Err(Malformed::Value { field, found }.into()),
    };
    let mut integer = |bit: u8, default| {
        let is_given = given & bit != 0;
        let value = is_given.then(|| reader.small_integer("chainLength"));
        let value = value.transpose()?;
        if value == Some(default) {
            return Err(Malformed::ExplicitDefault(field));
        }
        Ok(value.unwrap_or(default))
    };
    let (min_chain_length, chain_length_range) = (integer(0x80, 1)?, integer(0x40, 0)?);
    let for_applications = match (given & 0x20 != 0).then(|| reader.octet("eeType")) {
        None => true,
        Some(types) => match types? {
            APPLICATIONS => return Err(Malformed::ExplicitDefault("eeType").into()),
            0 => return Err(Malformed::NotCanonical("eeType").into()),
            types => types & APPLICATIONS != 0,
        },
    };
    Ok(IssuePermission {
        subjects,
        min_chain_length,
        chain_length_range,
        for_applications,
    })
}

fn read_range(reader: &mut OerReader) -> Result<(u32, SspRange), Rejected> {
    let field = "sspRange";
    let has_range = preamble(reader, 0x80, field)? != 0;
    let its_aid = reader.unsigned("psid")?;
    let range = match has_range.then(|| reader.octet(field)).transpose()? {
        None | Some(0x81) => SspRange::All,
        Some(0x80) => {
            let one = |reader: &mut OerReader| Ok(reader.opaque(field)?.to_vec());
            SspRange::Opaque(list(true, reader, one)?)
        }
        Some(0x82) => {
            let mut inner = OerReader::new(reader.opaque(field)?);
            let value = inner.opaque("sspValue")?.to_vec();
            let mask = inner.opaque("sspBitmask")?.to_vec();
            inner.finish("bitmapSspRange")?;
            if value.len() != mask.len() {
                return Err(Malformed::NotCanonical(field).into());
            }
            SspRange::Bitmap { value, mask }
        }
        Some(found) => return Err(Malformed::Value { field, found }.into()),
    };
    Ok((its_aid, range))
}

/// The kit does not encrypt; a key for it is passed over.
fn skip_encryption_key<'a>(
    reader: &mut OerReader<'a>,
    canonical: &mut Canonical<'a>,
) -> Result<(), Rejected> {
    let field = "encryptionKey";
    reader.octet(field)?;
    match reader.octet(field)? {
        0x80 | 0x81 => {}
        _ => return Err(Rejected::Unsupported("an encryption key but ECIES")),
    }
    canonical.point(reader, field)?;
    Ok(())
}

fn read_verification_key<'a>(
    reader: &mut OerReader<'a>,
    canonical: &mut Canonical<'a>,
) -> Result<PublicKey, Rejected> {
    let field = "verifyKeyIndicator";
    match reader.octet(field)? {
        0x80 => {}
        0x81 => return Err(Rejected::Unsupported("an implicit certificate")),
        found => return Err(Malformed::Value { field, found }.into()),
    }
    match reader.octet(field)? {
        0x80 => Ok(canonical.point(reader, field)?),
        0x81..=0x84 => Err(Rejected::Unsupported("a curve other than NIST P-256")),
        found => Err(Malformed::Value { field, found }.into()),
    }
}
