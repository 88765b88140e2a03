//! The vectors, one by one, as `listed.txt` has them.

use crossguard_codec::Service;
use crossguard_codec::security::Time64;

use super::forge::{
    Envelope, Terms, issue_permissions, location, mirrored, permissions, with_r_form,
};
use super::pki::{NOW, NOW_S, after_ms};
use super::scene::{
    ALL, ANTIPODE, AUTHORITY, HERE, Heard, Pki, SENDER, STRANGER, Vector, Vectors, authority_terms,
    circle, envelope, identifiers, plain, secured, terms,
};
use crate::support::from_hex;

pub(crate) fn vectors() -> Vectors {
    let (pki, mut all, mut clause) = (Pki::new(), Vec::new(), "");
    let lines = include_str!("listed.txt").lines();
    for line in lines.filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some(heading) = line.strip_prefix('[') {
            clause = heading.trim_end_matches(']');
            continue;
        }
        let cells: Vec<&'static str> = line.split(" | ").collect();
        let mut heard: Vec<Heard> = Vec::new();
        for pair in cells[1..].chunks(2) {
            let (later, said) = pair[0].split_once(" ms later ").unwrap_or(("0", pair[0]));
            let at = after_ms(later.parse().unwrap());
            let packet = match (said, heard.last()) {
                ("again", Some(before)) => before.packet.clone(),
                ("again, mirrored", Some(before)) => mirrored(before.packet.clone()),
                _ => packet(&pki, said, at),
            };
            let refused = (pair[1] != "taken").then_some(pair[1]);
            heard.push(Heard {
                packet,
                at,
                refused,
            });
        }
        all.push(Vector {
            name: cells[0],
            clause,
            heard,
        });
    }
    Vectors { pki, all }
}

/// A packet that is said at this time, with what is out of the ordinary of it.
fn packet(pki: &Pki, said: &'static str, at: Time64) -> Vec<u8> {
    let mut words = said.split("; ");
    let service = service(words.next().unwrap());
    let changes: Vec<Vec<&str>> = words.map(|it| it.split(' ').collect()).collect();
    if changes == [["plain"]] {
        return plain(service, at, HERE);
    }
    let mut envelope = envelope(pki, service, at);
    let mut ticket = Ticket {
        terms: terms(SENDER),
        issuer: Some(pki.authority.clone()),
        by: AUTHORITY,
        is_uncompressed: false,
    };
    for change in &changes {
        match &change[..] {
            ["ticket", change @ ..] => ticket.change(change),
            change => envelope.change(service, change),
        }
    }
    let issuer = ticket.issuer.as_deref();
    envelope.certificate = ticket.terms.signed(issuer, ticket.by);
    if !envelope.sent.is_empty() {
        let sent = ticket
            .terms
            .sent(issuer, ticket.by, !ticket.is_uncompressed);
        envelope.sent = with_r_form(sent, envelope.r_form);
    }
    let mut octets = envelope.octets();
    for change in &changes {
        garble(&mut octets, change);
    }
    secured(&octets)
}

fn service(name: &str) -> Service {
    let mut all = Service::ALL.into_iter();
    all.find(|service| service.name() == name).expect(name)
}

fn place(name: &str) -> (i32, i32) {
    match name {
        "here" => HERE,
        "nowhere" => (2_000_000_000, HERE.1),
        // 2.2 km to the north, behind the border of the region.
        "outside" => (HERE.0 + 200_000, HERE.1),
        "22km" => (HERE.0 + 2_000_000, HERE.1),
        "antipode" => ANTIPODE,
        _ => panic!("{name} is no place"),
    }
}

fn time(us: &str) -> Time64 {
    Time64(NOW.0.strict_add_signed(us.parse().expect(us)))
}

impl Envelope {
    fn change(&mut self, service: Service, change: &[&str]) {
        match change {
            ["located", at] => self.is_located(place(at)),
            ["from", at] => self.is_said(service, NOW, place(at)),
            ["positioned", us] => self.is_said(service, time(us), HERE),
            ["generated", us] => {
                self.generated_us = time(us).0;
                self.is_said(service, time(us), HERE);
            }
            ["expires", us] => self.expires(time(us).0),
            ["digest"] => self.sent.clear(),
            ["preamble", bits] => self.preamble = from_hex(bits)[0],
            ["additions", octets] => self.additions = from_hex(octets),
            ["permission", other] => self.its_aid = self::service(other).its_aid(&identifiers()),
            ["signed", "by", "stranger"] => self.key = STRANGER,
            ["rSig", form] => self.r_form = from_hex(form)[0],
            ["octet" | "append" | "cut" | "zeros" | "mirrored", ..] => {}
            _ => panic!("{change:?} is no change of an envelope"),
        }
    }
}

/// The ticket of a sender, and who issues it.
struct Ticket {
    terms: Terms,
    issuer: Option<Vec<u8>>,
    /// The key that signs it.
    by: u8,
    is_uncompressed: bool,
}

impl Ticket {
    fn change(&mut self, change: &[&'static str]) {
        let terms = &mut self.terms;
        match change {
            ["region", at] => terms.region = circle(place(at), 500),
            // About a degree to each side of it.
            ["region", "rectangle", at] => {
                let ((north, east), degree) = (place(at), 10_000_000);
                let corners = [
                    (north + degree, east - degree),
                    (north - degree, east + degree),
                ];
                terms.region = [vec![0x81, 1, 1], corners.map(location).concat()].concat();
            }
            ["region", "octets", octets] => terms.region = from_hex(octets),
            ["assurance", level] => terms.assurance = from_hex(level),
            ["encryption", algorithms] => terms.encryption = from_hex(algorithms),
            ["uncompressed"] => self.is_uncompressed = true,
            ["unit", unit] => terms.unit = unit.parse().expect(unit),
            ["permissions", octets] => terms.permissions = from_hex(octets),
            ["additions", octets] => terms.additions = from_hex(octets),
            ["issues", "with", "default"] => terms.issue = issue_permissions(0x20, &ALL, &[0x80]),
            ["name", name] => terms.name = Some(name),
            ["start", s] => terms.start = NOW_S.strict_add_signed(s.parse().expect(s)),
            ["hours", hours] => terms.hours = hours.parse().expect(hours),
            ["permits", its_aids @ ..] => {
                let its_aids = its_aids.iter().map(|it| it.parse().expect(it));
                terms.permissions = permissions(&its_aids.collect::<Vec<_>>());
            }
            ["below", "stranger"] => {
                self.issuer = Some(authority_terms().signed(Some(&[1, 2, 3]), STRANGER));
            }
            ["itself"] => (self.issuer, self.by) = (None, SENDER),
            ["signed", "by", "stranger"] => self.by = STRANGER,
            _ => panic!("{change:?} is no change of a ticket"),
        }
    }
}

/// Changes octets after they were signed. A place below zero counts from the end.
fn garble(octets: &mut Vec<u8>, change: &[&str]) {
    let end = octets.len();
    match change {
        ["octet", "of", "the", "header", "=", octet] => {
            let head = [0x40, 2, 0x40, 0x60];
            let at = octets.windows(4).position(|it| it == head).unwrap();
            octets[at] = from_hex(octet)[0];
        }
        // Of the certificate that goes along, and of the tag and the quantity in front of it.
        ["octet", at, "of", "the", "certificate", "=", octet] => {
            let start = octets
                .windows(6)
                .position(|it| it == [0x81, 1, 1, 0x80, 3, 0]);
            let at: isize = at.parse().expect(at);
            octets[(start.unwrap() + 3).strict_add_signed(at)] = from_hex(octet)[0];
        }
        ["mirrored"] => *octets = mirrored(std::mem::take(octets)),
        ["octet", at, "=", octet] => {
            let at: isize = at.parse().expect(at);
            let from = if at < 0 { end } else { 0 };
            octets[from.strict_add_signed(at)] = from_hex(octet)[0];
        }
        ["append", more] => octets.extend(from_hex(more)),
        ["cut", count] => octets.truncate(end - count.parse::<usize>().expect(count)),
        ["zeros", count] => octets[end - count.parse::<usize>().expect(count)..].fill(0),
        _ => {}
    }
}
