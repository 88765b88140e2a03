//! The certificates of a PKI against the profiles of TS 103 097, clause 7.2, as rasn-its reads them.

use crossguard_codec::Identifiers;
use crossguard_codec::Part;
use crossguard_codec::security::{Certificate, PrivateKey, Time64};
use crossguard_robot::pki::{self, Term};
use rasn_its::ieee1609dot2 as dot2;
use rasn_its::ieee1609dot2::base_types as base;
use rasn_its::ts103097::EtsiTs103097Certificate;

/// 2026-01-05.
const NOW: Time64 = Time64(694_694_401_000_000);

fn its_aids() -> Vec<u32> {
    pki::its_aids(&Identifiers::default())
}

/// A certificate as another implementation reads it, which writes the same octets.
fn decoded(certificate: &Certificate) -> EtsiTs103097Certificate {
    let theirs: dot2::Certificate = rasn::coer::decode(certificate.octets()).unwrap();
    assert_eq!(rasn::coer::encode(&theirs).unwrap(), certificate.octets());
    EtsiTs103097Certificate::try_from(theirs).unwrap()
}

/// The services of `appPermissions`, with their bits.
fn permits(certificate: &dot2::ToBeSignedCertificate) -> Vec<(u32, Vec<u8>)> {
    let all = certificate.app_permissions.iter().flat_map(|all| &all.0);
    let one = |permission: &base::PsidSsp| {
        let Some(base::ServiceSpecificPermissions::BitmapSsp(bits)) = &permission.ssp else {
            panic!("{permission:?} has no bits")
        };
        (u32::try_from(&permission.psid.0).unwrap(), bits.0.to_vec())
    };
    all.map(one).collect()
}

/// Rules of clause 6 for all certificates.
fn check_common(certificate: &EtsiTs103097Certificate) {
    assert_eq!(certificate.version, 3);
    assert_eq!(certificate.r#type, dot2::CertificateType::Explicit);
    let signed = &certificate.to_be_signed;
    assert_eq!(*signed.craca_id.0, [0; 3]);
    assert_eq!(signed.crl_series.0, 0);
    let dot2::VerificationKeyIndicator::VerificationKey(key) = &signed.verify_key_indicator else {
        panic!("an implicit certificate")
    };
    let base::PublicVerificationKey::EcdsaNistP256(point) = key else {
        panic!("{key:?}")
    };
    assert!(is_compressed(point), "{point:?}");
}

const fn is_compressed(point: &base::EccP256CurvePoint) -> bool {
    use base::EccP256CurvePoint as Point;
    matches!(point, Point::CompressedY0(_) | Point::CompressedY1(_))
}

#[test]
fn root_authority_and_ticket_have_the_profiles_of_ts_103_097() {
    let encryption = PrivateKey::generate().public_key();
    let root = pki::new_root(
        PrivateKey::generate(),
        "root",
        Term::hours(NOW, 1_000),
        &its_aids(),
    )
    .unwrap();
    let keys = (PrivateKey::generate(), encryption);
    let below = Term::hours(NOW, 500);
    let authority = pki::new_authority(keys, &root, "below", below, &its_aids()).unwrap();
    let permissions = pki::robot_permissions(&Identifiers::default(), &[Part::Help], None);
    let ticket = pki::new_ticket(
        PrivateKey::generate(),
        &authority,
        Term::hours(NOW, 24),
        permissions,
    )
    .unwrap();
    let issuer = dot2::IssuerIdentifier::Sha256AndDigest(base::HashedId8(
        authority.certificate.id().0.into(),
    ));
    let [root, authority, ticket] = [root, authority, ticket].map(|it| decoded(&it.certificate));
    for certificate in [&root, &authority, &ticket] {
        check_common(certificate);
    }

    // 7.2.3: signs itself, revocation lists and trust lists.
    let itself = dot2::IssuerIdentifier::VSelf(base::HashAlgorithm::Sha256);
    assert_eq!(root.issuer, itself);
    let signed = &root.to_be_signed;
    assert!(matches!(signed.id, dot2::CertificateId::Name(_)));
    assert_eq!(permits(signed), [(622, vec![1]), (624, vec![1, 0x38])]);
    assert!(signed.cert_issue_permissions.is_some());
    assert_eq!(signed.encryption_key, None);

    // 7.2.4: answers requests, which are encrypted with a key of its own for that.
    let signed = &authority.to_be_signed;
    assert!(matches!(signed.id, dot2::CertificateId::Name(_)));
    assert_eq!(permits(signed), [(623, vec![1, 0x30])]);
    assert!(signed.cert_issue_permissions.is_some());
    let key = signed.encryption_key.as_ref().expect("an encryption key");
    assert_eq!(key.supported_symm_alg, base::SymmAlgorithm::Aes128Ccm);
    let base::BasePublicEncryptionKey::EciesNistP256(point) = &key.public_key else {
        panic!("{key:?}")
    };
    assert!(is_compressed(point), "{point:?}");

    // 7.2.1: no name, and nothing to issue.
    assert_eq!(ticket.issuer, issuer);
    let signed = &ticket.to_be_signed;
    assert_eq!(signed.id, dot2::CertificateId::None(()));
    assert_eq!(permits(signed).len(), 4);
    assert_eq!(signed.cert_issue_permissions, None);
    assert_eq!(signed.encryption_key, None);
}
