//! Certificates, as people and scripts see them.

use std::path::Path;
use std::time::{Duration, UNIX_EPOCH};

use crossguard_codec::geonet::station_of;
use crossguard_codec::security::{
    Certificate, Content, Issuer, Permission, Place, Region, Ssp, Subjects, Time64,
};
use crossguard_codec::si::timestamp_its;
use crossguard_codec::{Identifiers, Service};
use serde::Serialize;

use super::super::{Failure, print};

/// 2004-01-01T00:00:00Z, in seconds since 1970.
const EPOCH_S: u64 = 1_072_915_200;

/// A certificate for people and scripts.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Shown {
    file: String,
    kind: &'static str,
    id: String,
    name: Option<String>,
    issuer: Option<String>,
    valid_from: String,
    valid_until: String,
    is_valid_now: bool,
    region: Option<String>,
    /// The station id that a robot with this ticket goes by.
    station: Option<u32>,
    permissions: Vec<String>,
    issues: Vec<String>,
}

impl Shown {
    pub(super) fn of(path: &Path, certificate: &Certificate, now: Time64) -> Self {
        let content = certificate.content();
        let validity = content.validity;
        Self {
            file: path.display().to_string(),
            kind: kind(content),
            id: certificate.id().to_string(),
            name: content.name.clone(),
            issuer: match content.issuer {
                Issuer::Certificate(id) => Some(id.to_string()),
                Issuer::Itself => None,
            },
            valid_from: date(validity.from()),
            valid_until: date(validity.until()),
            is_valid_now: (validity.from()..validity.until()).contains(&now),
            region: content.region.as_ref().map(region),
            station: station_of(certificate, Service::Ram.its_aid(&Identifiers::default()))
                .map(|station| station.0),
            permissions: content.permissions.iter().map(permitted).collect(),
            issues: content
                .issue_permissions
                .iter()
                .flat_map(|issue| match &issue.subjects {
                    Subjects::All => vec!["all services".to_owned()],
                    Subjects::These(these) => {
                        these.iter().map(|(its_aid, _)| service(*its_aid)).collect()
                    }
                })
                .collect(),
        }
    }

    pub(super) fn print(&self) -> Result<(), Failure> {
        let name = self
            .name
            .as_ref()
            .map_or_else(String::new, |name| format!(" '{name}'"));
        let validity = if self.is_valid_now {
            ""
        } else {
            ", NOT VALID NOW"
        };
        print(format_args!(
            "{} {}{name}: {}",
            self.kind, self.id, self.file
        ))?;
        let (from, until) = (&self.valid_from, &self.valid_until);
        print(format_args!("  valid from {from} until {until}{validity}"))?;
        if let Some(issuer) = &self.issuer {
            print(format_args!("  issued by {issuer}"))?;
        }
        if let Some(region) = &self.region {
            print(format_args!("  in {region}"))?;
        }
        if let Some(station) = self.station {
            print(format_args!("  goes by station {station}"))?;
        }
        for (what, list) in [("permits", &self.permissions), ("issues", &self.issues)] {
            if !list.is_empty() {
                print(format_args!("  {what} {}", list.join(", ")))?;
            }
        }
        Ok(())
    }
}

fn kind(content: &Content) -> &'static str {
    if content.issuer == Issuer::Itself {
        "root"
    } else if content.is_ticket() {
        "ticket"
    } else if content.issue_permissions.is_empty() {
        "certificate"
    } else {
        "authority"
    }
}

fn service(its_aid: u32) -> String {
    let identifiers = Identifiers::default();
    let service = Service::ALL
        .into_iter()
        .find(|service| service.its_aid(&identifiers) == its_aid);
    service.map_or_else(
        || its_aid.to_string(),
        |service| format!("{} ({its_aid})", service.name()),
    )
}

fn permitted(permission: &Permission) -> String {
    let service = service(permission.its_aid);
    match &permission.ssp {
        Ssp::Default => service,
        Ssp::Opaque(octets) => format!("{service} with octets {}", hex::encode(octets)),
        Ssp::Bitmap(bits) => format!("{service} with bits {}", hex::encode(bits)),
    }
}

fn region(region: &Region) -> String {
    let degrees = |place: &Place| {
        let (latitude, longitude) = (f64::from(place.latitude), f64::from(place.longitude));
        format!("{:.7}, {:.7}", latitude / 1e7, longitude / 1e7)
    };
    match region {
        Region::Circle { centre, radius } => {
            format!("a circle of {radius} m around {}", degrees(centre))
        }
        Region::Rectangles(rectangles) => rectangles
            .iter()
            .map(|(north_west, south_east)| {
                format!(
                    "a rectangle from {} to {}",
                    degrees(north_west),
                    degrees(south_east)
                )
            })
            .collect::<Vec<_>>()
            .join(" and "),
    }
}

/// A time as a date of the common calendar; leap seconds are taken out.
fn date(time: Time64) -> String {
    let its_s = time.0 / 1_000_000;
    let unix_s = (0..=5)
        .map(|leap| its_s + EPOCH_S - leap)
        .find(|unix_s| {
            let unix_ms = i64::try_from(unix_s * 1_000).unwrap_or(i64::MAX);
            timestamp_its(unix_ms) == its_s * 1_000
        })
        .unwrap_or(its_s + EPOCH_S);
    humantime::format_rfc3339_seconds(UNIX_EPOCH + Duration::from_secs(unix_s)).to_string()
}
