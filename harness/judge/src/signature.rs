//! Signer of a packet that somebody listened in to, and whether the signature can be relied on.

use crossguard_codec::geonet::{BasicHeader, Headers, NextHeader, origin};
use crossguard_codec::security::{
    SignedMessage, SignerIdentifier, Time64, Tolerances, TrustStore, Verifier,
};
use crossguard_codec::{Identifiers, Service};
use serde::Serialize;

/// The signature of a packet.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Signature {
    /// The permission that it was sent under (ITS-AID).
    pub its_aid: u32,
    /// The ticket of its signer (`HashedId8`).
    pub signer: String,
    /// Whether that ticket came along, and not its digest alone.
    pub has_certificate: bool,
    /// When it was signed: microseconds of `TimestampIts`.
    pub generation_time_us: u64,
    /// Whether a root that is trusted vouches for the signer, and the signature is the signer's.
    pub is_verified: bool,
    /// Why it is not verified.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_not: Option<String>,
}

/// Looks at the signatures of packets, and verifies them where roots are given.
#[derive(Clone, Debug, Default)]
pub struct Signatures {
    verifier: Option<Verifier>,
}

impl Signatures {
    /// Verifies by what these roots vouch for.
    #[must_use]
    pub fn trusting(trust: TrustStore) -> Self {
        // A listener is not in a hurry, and where it is does not matter.
        let tolerances = Tolerances {
            new_per_s: u32::MAX,
            ..Tolerances::default()
        };
        let verifier = Verifier::new(trust, tolerances, Vec::new());
        Self {
            verifier: Some(verifier),
        }
    }

    /// The signature of a packet that was heard at `now`, or when it was signed if that is not known. `None`
    /// where it has none, or is no packet.
    pub fn of(
        &mut self,
        identifiers: &Identifiers,
        packet: &[u8],
        now: Option<Time64>,
    ) -> Option<Signature> {
        let (basic, secured) = BasicHeader::decode(packet).ok()?;
        if basic.next != NextHeader::Secured {
            return None;
        }
        let message = SignedMessage::decode(secured).ok()?;
        let headers = Headers::decode_behind(basic, message.payload).ok();
        let headers = headers.map(|(headers, _)| headers);
        let why_not = self.why_not(identifiers, headers.as_ref(), now, &message);
        Some(Signature {
            its_aid: message.header.its_aid,
            signer: message.signer.id().to_string(),
            has_certificate: matches!(message.signer, SignerIdentifier::Certificate(_)),
            generation_time_us: message.header.generation_time.0,
            is_verified: why_not.is_none(),
            why_not,
        })
    }

    fn why_not(
        &mut self,
        identifiers: &Identifiers,
        headers: Option<&Headers>,
        now: Option<Time64>,
        message: &SignedMessage<'_>,
    ) -> Option<String> {
        let Some(verifier) = &mut self.verifier else {
            return Some("no roots were given".to_owned());
        };
        let its_aid = message.header.its_aid;
        let service = headers.and_then(|it| Service::at_port(identifiers, it.port));
        if let Some(service) = service
            && service.its_aid(identifiers) != its_aid
        {
            let name = service.name();
            return Some(format!(
                "signed under ITS-AID {its_aid}, which is not that of {name}"
            ));
        }
        let origin = headers.map(|headers| origin(&headers.source));
        let is_of_robot = matches!(service, Some(Service::Ram | Service::Rmcm));
        let profile = if is_of_robot {
            message.header.check_robot_profile()
        } else {
            Ok(())
        };
        let fits = origin.map_or(Ok(()), |it| verifier.check_origin(None, &it, message));
        let now = now.unwrap_or(message.header.generation_time);
        let place = origin.and_then(|origin| origin.place);
        let result = profile
            .and(fits)
            .and_then(|()| verifier.verify(now, place, message));
        result.err().map(|rejected| rejected.to_string())
    }
}
