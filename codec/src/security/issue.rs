//! Issuing certificates: what a test PKI needs.
//!
//! Certificates are built with the types of `rasn-its`, and read back by the decoder of this crate, so
//! that nothing is issued that stations would not take.

use rasn::types::{FixedOctetString, Integer, OctetString, SequenceOf};
use rasn_its::ieee1609dot2 as dot2;
use rasn_its::ieee1609dot2::base_types as base;

use super::certificate::{Certificate, Issuer};
use super::crypto::{self, PublicKey, Signature};
use super::permissions::{IssuePermission, Permission, Ssp, SspRange, Subjects};
use super::region::{Place, Region};
use super::rejected::Rejected;
use super::signer::{KeyFailure, SigningKey};
use super::time::{Unit, Validity};
use super::trust::{TrustStore, Untrusted};

/// Terms of a new certificate.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Terms {
    /// Its name; `None` for tickets.
    pub name: Option<String>,
    /// When it is to be valid.
    pub validity: Validity,
    /// Where it is to be valid; anywhere, if that is not said.
    pub region: Option<Region>,
    /// Permissions of its holder to send messages.
    pub permissions: Vec<Permission>,
    /// Permissions of its holder to issue certificates.
    pub issue_permissions: Vec<IssuePermission>,
    /// The key to encrypt for its holder with, by ECIES and AES-128: authorities have one (TS 103 097, clause 7.2.4).
    pub encryption_key: Option<PublicKey>,
}

impl Terms {
    /// The terms of a pseudonym, which is valid everywhere.
    #[must_use]
    pub const fn of_ticket(validity: Validity, permissions: Vec<Permission>) -> Self {
        Self {
            name: None,
            validity,
            region: None,
            permissions,
            issue_permissions: Vec::new(),
            encryption_key: None,
        }
    }
}

/// Why a certificate cannot be issued.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IssueError {
    /// The terms cannot be expressed, for example because nothing is permitted.
    #[error("these terms cannot be expressed in a certificate: {0}")]
    Terms(String),
    /// No station would take the certificate.
    #[error("nobody would take this certificate: {0}")]
    Rejected(#[from] Rejected),
    /// No station would trust the authority.
    #[error("nobody would trust this authority: {0}")]
    Untrusted(#[from] Untrusted),
    /// The issuer's key could not be used.
    #[error("{0}")]
    Key(#[from] KeyFailure),
}

/// Issues the certificate of a root, which signs itself.
///
/// # Errors
/// Why it cannot.
pub fn root(key: &dyn SigningKey, terms: &Terms) -> Result<Certificate, IssueError> {
    let root = certificate(Issuer::Itself, &[], key, key.public_key(), terms)?;
    TrustStore::default().add_root(root.clone())?;
    Ok(root)
}

/// Issues the certificate of an authority that issues tickets.
///
/// # Errors
/// Why `root` cannot.
pub fn authority(
    root: &Certificate,
    root_key: &dyn SigningKey,
    holder: PublicKey,
    terms: &Terms,
) -> Result<Certificate, IssueError> {
    let issuer = Issuer::Certificate(root.id());
    let authority = certificate(issuer, root.octets(), root_key, holder, terms)?;
    let mut trust = TrustStore::default();
    trust.add_root(root.clone())?;
    trust.add_authority(authority.clone())?;
    Ok(authority)
}

/// Issues a pseudonym: an authorization ticket.
///
/// # Errors
/// Why `authority` cannot.
pub fn ticket(
    authority: &Certificate,
    authority_key: &dyn SigningKey,
    holder: PublicKey,
    terms: &Terms,
) -> Result<Certificate, IssueError> {
    let issuer = Issuer::Certificate(authority.id());
    let ticket = certificate(issuer, authority.octets(), authority_key, holder, terms)?;
    TrustStore::check_ticket(&ticket, authority)?;
    if !ticket.is_signed_by(Some(authority)) {
        return Err(Rejected::CertificateSignature(ticket.id()).into());
    }
    Ok(ticket)
}

/// A certificate on these terms, without a check that a receiver would take it.
///
/// # Errors
/// When the terms cannot be expressed.
pub fn certificate(
    issuer: Issuer,
    issuer_octets: &[u8],
    issuer_key: &dyn SigningKey,
    holder: PublicKey,
    terms: &Terms,
) -> Result<Certificate, IssueError> {
    let to_be_signed = to_be_signed(holder, terms)?;
    let octets = rasn::coer::encode(&to_be_signed).map_err(inexpressible)?;
    let above = (!issuer_octets.is_empty()).then(|| crypto::sha256(issuer_octets));
    let signature = issuer_key.sign(&crypto::to_be_signed(&octets, above.as_ref()))?;
    let whole = dot2::CertificateBase {
        version: dot2::CertificateBase::VERSION,
        r#type: dot2::CertificateType::Explicit,
        issuer: match issuer {
            Issuer::Certificate(id) => {
                dot2::IssuerIdentifier::Sha256AndDigest(base::HashedId8(id.0.into()))
            }
            Issuer::Itself => dot2::IssuerIdentifier::VSelf(base::HashAlgorithm::Sha256),
        },
        to_be_signed,
        signature: Some(signature_of(&signature)),
    };
    let octets = rasn::coer::encode(&whole).map_err(inexpressible)?;
    Ok(Certificate::decode(&octets)?)
}

fn inexpressible(error: impl std::fmt::Display) -> IssueError {
    IssueError::Terms(error.to_string())
}

fn to_be_signed(
    holder: PublicKey,
    terms: &Terms,
) -> Result<dot2::ToBeSignedCertificate, IssueError> {
    let Terms {
        name,
        validity,
        region,
        permissions,
        issue_permissions,
        encryption_key,
    } = terms;
    let permissions: Vec<_> = permissions.iter().map(permission).collect();
    let issue: Vec<_> = issue_permissions.iter().map(issue_permission).collect();
    dot2::ToBeSignedCertificate::builder()
        .id(match name {
            Some(name) => dot2::CertificateId::Name(base::Hostname(name.clone())),
            None => dot2::CertificateId::None(()),
        })
        .craca_id(base::HashedId3([0; 3].into()))
        .crl_series(base::CrlSeries(0))
        .validity_period(validity_of(*validity))
        .maybe_region(region.as_ref().map(region_of).transpose()?)
        .maybe_app_permissions(some(permissions).map(base::SequenceOfPsidSsp))
        .maybe_cert_issue_permissions(some(issue).map(dot2::SequenceOfPsidGroupPermissions))
        .maybe_encryption_key(encryption_key.map(|key| base::PublicEncryptionKey {
            supported_symm_alg: base::SymmAlgorithm::Aes128Ccm,
            public_key: base::BasePublicEncryptionKey::EciesNistP256(point(key)),
        }))
        .verify_key_indicator(dot2::VerificationKeyIndicator::VerificationKey(
            base::PublicVerificationKey::EcdsaNistP256(point(holder)),
        ))
        .build()
        .map_err(inexpressible)
}

fn some<T>(list: Vec<T>) -> Option<SequenceOf<T>> {
    (!list.is_empty()).then_some(list)
}

fn validity_of(validity: Validity) -> base::ValidityPeriod {
    let number = validity.duration.number;
    base::ValidityPeriod {
        start: base::Time32(validity.start),
        duration: match validity.duration.unit {
            Unit::Microseconds => base::Duration::Microseconds(number),
            Unit::Milliseconds => base::Duration::Milliseconds(number),
            Unit::Seconds => base::Duration::Seconds(number),
            Unit::Minutes => base::Duration::Minutes(number),
            Unit::Hours => base::Duration::Hours(number),
            Unit::SixtyHours => base::Duration::SixtyHours(number),
            Unit::Years => base::Duration::Years(number),
        },
    }
}

fn region_of(region: &Region) -> Result<base::GeographicRegion, IssueError> {
    Ok(match region {
        Region::Circle { centre, radius } => {
            base::GeographicRegion::CircularRegion(base::CircularRegion {
                center: place(*centre)?,
                radius: *radius,
            })
        }
        Region::Rectangles(rectangles) => {
            let corners = |(north_west, south_east): &(Place, Place)| {
                Ok(base::RectangularRegion {
                    north_west: place(*north_west)?,
                    south_east: place(*south_east)?,
                })
            };
            let rectangles: Result<_, IssueError> = rectangles.iter().map(corners).collect();
            base::GeographicRegion::RectangularRegion(base::SequenceOfRectangularRegion(
                rectangles?,
            ))
        }
    })
}

fn place(place: Place) -> Result<base::TwoDLocation, IssueError> {
    let latitude = base::NinetyDegreeInt::new(place.latitude);
    let longitude = base::OneEightyDegreeInt::new(place.longitude);
    match (latitude, longitude) {
        (Some(latitude), Some(longitude)) => Ok(base::TwoDLocation {
            latitude: base::Latitude(latitude),
            longitude: base::Longitude(longitude),
        }),
        _ => Err(IssueError::Terms(format!("{place:?} is not on earth"))),
    }
}

fn psid(its_aid: u32) -> base::Psid {
    base::Psid(Integer::from(its_aid))
}

fn octets(octets: &[u8]) -> OctetString {
    OctetString::from_slice(octets)
}

fn permission(permission: &Permission) -> base::PsidSsp {
    use base::ServiceSpecificPermissions as Specific;
    base::PsidSsp {
        psid: psid(permission.its_aid),
        ssp: match &permission.ssp {
            Ssp::Default => None,
            Ssp::Opaque(ssp) => Some(Specific::Opaque(octets(ssp))),
            Ssp::Bitmap(bits) => Some(Specific::BitmapSsp(base::BitmapSsp(octets(bits)))),
        },
    }
}

fn issue_permission(issue: &IssuePermission) -> dot2::PsidGroupPermissions {
    let subjects = match &issue.subjects {
        Subjects::All => dot2::SubjectPermissions::All(()),
        Subjects::These(these) => dot2::SubjectPermissions::Explicit(base::SequenceOfPsidSspRange(
            these.iter().map(range).collect(),
        )),
    };
    dot2::PsidGroupPermissions::builder()
        .subject_permissions(subjects)
        .min_chain_length(Integer::from(issue.min_chain_length))
        .chain_length_range(Integer::from(issue.chain_length_range))
        .build()
}

fn range((its_aid, range): &(u32, SspRange)) -> base::PsidSspRange {
    base::PsidSspRange {
        psid: psid(*its_aid),
        ssp_range: Some(match range {
            SspRange::All => base::SspRange::All(()),
            SspRange::Opaque(listed) => {
                base::SspRange::Opaque(listed.iter().map(|ssp| octets(ssp)).collect())
            }
            SspRange::Bitmap { value, mask } => {
                base::SspRange::BitmapSspRange(base::BitmapSspRange {
                    ssp_value: octets(value),
                    ssp_bitmask: octets(mask),
                })
            }
        }),
    }
}

fn point(key: PublicKey) -> base::EccP256CurvePoint {
    let (is_odd, x) = key.coordinates();
    let x = FixedOctetString::new(x);
    if is_odd {
        base::EccP256CurvePoint::CompressedY1(x)
    } else {
        base::EccP256CurvePoint::CompressedY0(x)
    }
}

fn signature_of(signature: &Signature) -> base::Signature {
    let (r, s) = signature.numbers();
    base::Signature::EcdsaNistP256(base::EcdsaP256Signature {
        r_sig: base::EccP256CurvePoint::XOnly(FixedOctetString::new(r)),
        s_sig: FixedOctetString::new(s),
    })
}
