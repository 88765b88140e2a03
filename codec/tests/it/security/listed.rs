//! The vectors, one by one: what is taken, and what is refused under which cause.

use crossguard_codec::Service;
use crossguard_codec::security::Time64;

use super::forge::Terms;
use super::forge::{issue_permissions, opaque, permissions};
use super::pki::{NOW, NOW_S, after_ms};
use super::scene::{
    ALL, ANTIPODE, AUTHORITY, CAM, HERE, Pki, RAM, RMCM, SENDER, STRANGER, Vectors,
    authority_terms, circle, envelope, heard, plain, secured, terms,
};

fn taken(all: &mut Vectors) {
    let of_profile = "TS 103 097 7.1.1";
    all.takes(
        ("a RAM with its certificate", of_profile),
        Service::Ram,
        |_, _| {},
    );
    all.takes(("an RMCM", of_profile), Service::Rmcm, |_, _| {});
    all.takes(("a CAM", of_profile), Service::Cam, |_, _| {});
    all.takes(
        ("a DENM where it was generated", "TS 103 097 7.1.2"),
        Service::Denm,
        |it, _| it.is_located(HERE),
    );
    all.takes(
        ("a VAM that expires", "TS 103 097 7.1.3"),
        Service::Vam,
        |it, _| it.expires(NOW.0 + 500_000),
    );
    all.takes(
        (
            "a request for a certificate, as in 2016",
            "IEEE 1609.2 6.3 HeaderInfo",
        ),
        Service::Ram,
        |it, _| {
            it.additions = [&[2, 6, 0x80][..], &opaque(&[1, 1, 0xaa, 0xbb, 0xcc])].concat();
        },
    );
    all.takes(
        (
            "a ticket for its region",
            "IEEE 1609.2 6.4 GeographicRegion",
        ),
        Service::Ram,
        |it, pki| {
            it.certificate = pki.other(|it| it.region = circle(HERE, 500));
        },
    );
    let mut first = envelope(&all.pki, Service::Ram, NOW);
    let mut second = envelope(&all.pki, Service::Ram, after_ms(100));
    second.in_full = false;
    let both = vec![
        heard(secured(&first.octets()), NOW, None),
        heard(secured(&second.octets()), after_ms(100), None),
    ];
    all.add(
        "a RAM by the digest of a certificate that is known",
        of_profile,
        both,
    );
    // One of the two is y's parity, and no signature covers it.
    for (form, name) in [
        (0x82, "rSig as a point with an even y"),
        (0x83, "rSig as a point with an odd y"),
    ] {
        first.r_forms = [form; 2];
        second.r_forms = [form; 2];
        let both = vec![
            heard(secured(&first.octets()), NOW, None),
            heard(secured(&second.octets()), after_ms(100), None),
        ];
        all.add(name, "IEEE 1609.2 6.3 EccP256CurvePoint", both);
    }
}

fn profiles(all: &mut Vectors) {
    let header = |name| (name, "TS 103 097 5.2");
    let profile = "against profile";
    all.refuses(
        header("pduFunctionalType of another protocol"),
        "functional type of another protocol",
        Service::Ram,
        |it, _| it.additions = vec![2, 4, 0x20, 1, 1],
    );
    let robots = |name| (name, "TS 103 097 7.1.1");
    let cause = "expiry not allowed";
    for service in [Service::Ram, Service::Rmcm] {
        all.refuses(
            robots("expiryTime in RAM or RMCM"),
            cause,
            service,
            |it, _| it.expires(NOW.0 + 500_000),
        );
        let cause = "generation location not allowed";
        all.refuses(
            robots("generationLocation in RAM or RMCM"),
            cause,
            service,
            |it, _| it.is_located(HERE),
        );
    }
    all.refuses(
        robots("generationLocation in CAM"),
        profile,
        Service::Cam,
        |it, _| it.is_located(HERE),
    );
    let denm = |name| (name, "TS 103 097 7.1.2");
    all.refuses(
        denm("a DENM without generationLocation"),
        profile,
        Service::Denm,
        |_, _| {},
    );
    all.refuses(denm("a DENM by digest"), profile, Service::Denm, |it, _| {
        it.is_located(HERE);
        it.in_full = false;
    });
    for (bit, name) in [
        (0x08, "p2pcdLearningRequest"),
        (0x04, "missingCrlIdentifier"),
        (0x02, "encryptionKey"),
    ] {
        all.refuses(header(name), profile, Service::Ram, |it, _| {
            it.preamble = bit;
        });
    }
    let times = |name| (name, "IEEE 1609.2 6.3 HeaderInfo");
    let cause = "expiry before generation";
    all.refuses(
        times("expiryTime that is generationTime"),
        cause,
        Service::Vam,
        |it, _| it.expires(NOW.0),
    );
    all.refuses(
        times("expiryTime that is over"),
        "message expired",
        Service::Vam,
        |it, _| {
            it.generated_us -= 1_000_000;
            it.is_said(Service::Vam, Time64(it.generated_us), HERE);
            it.expires(NOW.0 - 1);
        },
    );
    let cause = "malformed envelope";
    all.refuses(
        header("a bitmap of additions of which none is there"),
        cause,
        Service::Ram,
        |it, _| {
            it.additions = vec![2, 4, 0];
        },
    );
}

fn places_and_times(all: &mut Vectors) {
    let nowhere = (2_000_000_000, HERE.1);
    let on_earth = |name| (name, "IEEE 1609.2 6.3 Latitude, Longitude");
    let cause = "place not on earth";
    all.refuses(
        on_earth("generationLocation at 200 degrees"),
        cause,
        Service::Vam,
        |it, _| it.is_located(nowhere),
    );
    all.refuses(
        on_earth("source position at 200 degrees"),
        cause,
        Service::Ram,
        |it, _| it.is_said(Service::Ram, NOW, nowhere),
    );
    all.refuses(
        on_earth("a region at 200 degrees"),
        cause,
        Service::Ram,
        |it, pki| {
            it.certificate = pki.other(|it| it.region = circle(nowhere, 500));
        },
    );
    let region = |name| (name, "IEEE 1609.2 5.2 consistency with the certificate");
    // 2.2 km to the north of the region.
    let outside = (HERE.0 + 200_000, HERE.1);
    let cause = "outside region";
    all.refuses(
        region("a sender outside of the region of its ticket"),
        cause,
        Service::Ram,
        |it, pki| {
            it.is_said(Service::Ram, NOW, outside);
            it.certificate = pki.other(|it| it.region = circle(HERE, 500));
        },
    );
    all.refuses(
        region("generationLocation within the region, and the sender outside"),
        cause,
        Service::Denm,
        |it, pki| {
            it.is_said(Service::Denm, NOW, outside);
            it.is_located(HERE);
            it.certificate = pki.other(|it| it.region = circle(HERE, 500));
        },
    );
    let elsewhere = "generation location elsewhere";
    let there = (
        "generationLocation 22 km away from the sender",
        "TS 103 097 7.1.2",
    );
    all.refuses(there, elsewhere, Service::Denm, |it, _| {
        it.is_located((HERE.0 + 2_000_000, HERE.1));
    });
    let plausible = |name| (name, "IEEE 1609.2 5.2 relevance");
    all.refuses(
        plausible("a sender on the other side of the earth"),
        "too far away",
        Service::Ram,
        |it, _| it.is_said(Service::Ram, NOW, ANTIPODE),
    );
    let cause = "position vector of another time";
    for (name, at) in [
        ("a GeoNetworking time of an hour ago", NOW.0 - 3_600_000_000),
        (
            "a GeoNetworking time of half a second ahead",
            NOW.0 + 500_000,
        ),
    ] {
        all.refuses(plausible(name), cause, Service::Ram, |it, _| {
            it.is_said(Service::Ram, Time64(at), HERE);
        });
    }
    for (name, cause, generated_us) in [
        ("generated 2.1 s ago", "too old", NOW.0 - 2_100_000),
        (
            "generated in the future",
            "from the future",
            NOW.0 + 230_000,
        ),
    ] {
        all.refuses(plausible(name), cause, Service::Ram, |it, _| {
            it.generated_us = generated_us;
            it.is_said(Service::Ram, Time64(generated_us), HERE);
        });
    }
}

#[expect(clippy::too_many_lines, reason = "a list")]
fn certificates(all: &mut Vectors) {
    let of = |name| (name, "IEEE 1609.2 6.4");
    let mut bad = |name, clause, cause, change: fn(&mut Terms)| {
        all.refuses((name, clause), cause, Service::Ram, |it, pki| {
            it.certificate = pki.other(change);
        });
    };
    let (content, chain) = (
        "IEEE 1609.2 6.4 ToBeSignedCertificate",
        "IEEE 1609.2 5.1 chains",
    );
    bad(
        "a ticket with an extension",
        content,
        "certificate extension",
        |it| {
            it.additions = vec![2, 4, 0x80, 1, 0];
        },
    );
    bad(
        "a default that is spelled out",
        "IEEE 1609.2 6.4 PsidGroupPermissions, COER",
        "explicit default",
        |it| {
            it.issue = issue_permissions(0x20, &ALL, &[0x80]);
        },
    );
    bad(
        "a ticket with a name",
        "TS 103 097 7.2.1",
        "not a ticket",
        |it| it.name = Some("me"),
    );
    bad(
        "a ticket that is over",
        chain,
        "certificate expired",
        |it| {
            it.start = NOW_S - 1_800;
            it.hours = 0;
        },
    );
    bad(
        "a ticket that is not valid yet",
        chain,
        "certificate not yet valid",
        |it| {
            it.start = NOW_S + 60;
        },
    );
    bad(
        "a ticket that outlives its issuer",
        chain,
        "validity beyond issuer",
        |it| it.hours = 900,
    );
    bad(
        "a permission that its issuer may not give",
        chain,
        "issuer not permitted",
        |it| {
            it.permissions = permissions(&[RAM, 637]);
        },
    );
    bad(
        "a ticket for another service",
        "IEEE 1609.2 5.2 consistency with the certificate",
        "not permitted",
        |it| {
            it.permissions = permissions(&[CAM]);
        },
    );
    all.refuses(
        ("a ticket of another root", chain),
        "foreign root",
        Service::Ram,
        |it, _| {
            let other = authority_terms().signed(Some(&[1, 2, 3]), STRANGER);
            it.certificate = terms(SENDER).signed(Some(&other), AUTHORITY);
        },
    );
    all.refuses(
        of("a ticket that its authority has not signed"),
        "wrong certificate signature",
        Service::Ram,
        |it, pki| {
            it.certificate = terms(SENDER).signed(Some(&pki.authority), STRANGER);
        },
    );
    all.refuses(
        of("a certificate that is not known, by its digest"),
        "unknown certificate",
        Service::Ram,
        |it, _| {
            it.in_full = false;
        },
    );
    all.refuses(
        ("the permission of another service", "TS 103 097 7.1"),
        "wrong permission for port",
        Service::Ram,
        |it, _| {
            it.its_aid = RMCM;
        },
    );
}

fn signatures(all: &mut Vectors) {
    let structure = |name| (name, "IEEE 1609.2 6.3");
    let malformed = "malformed envelope";
    all.garbled(structure("protocolVersion 2"), malformed, |it| it[0] = 2);
    all.garbled(structure("unsecured data"), "not signed", |it| it[1] = 0x80);
    all.garbled(
        structure("a hash other than SHA-256"),
        "unsupported",
        |it| it[2] = 1,
    );
    all.garbled(
        structure("an octet behind the signature"),
        malformed,
        |it| it.push(0),
    );
    all.garbled(structure("the last octet missing"), malformed, |it| {
        it.truncate(it.len() - 1);
    });
    all.garbled(
        structure("a signature on another curve"),
        "unsupported",
        |it| {
            let at = it.len() - 66;
            it[at] = 0x81;
        },
    );
    for (form, name, cause) in [
        (0x81, "rSig left out", malformed),
        (0x84, "rSig as an uncompressed point", "unsupported"),
    ] {
        all.garbled(structure(name), cause, |it| {
            let at = it.len() - 65;
            it[at] = form;
        });
    }
    all.garbled(structure("a signature of zeros"), malformed, |it| {
        let at = it.len() - 64;
        it[at..].fill(0);
    });
    let (name, clause) = ("no generationTime", "TS 103 097 5.2");
    let signed = envelope(&all.pki, Service::Ram, NOW);
    let head = [0x40, 2, 0x40, 0x60];
    all.garbled((name, clause), "against profile", |it| {
        let at = it.windows(4).position(|octets| octets == head).unwrap();
        it[at] = 0;
    });
    all.refuses(
        structure("signed with another key"),
        "wrong signature",
        Service::Ram,
        |it, _| {
            it.key = STRANGER;
        },
    );
    let twice = || secured(&signed.octets());
    let again = vec![
        heard(twice(), NOW, None),
        heard(twice(), after_ms(10), Some("replayed")),
    ];
    all.add("the same packet again", "IEEE 1609.2 5.2 replay", again);
    let mut forged = signed.clone();
    forged.key = STRANGER;
    let packet = secured(&forged.octets());
    let twice = vec![
        heard(packet.clone(), NOW, Some("wrong signature")),
        heard(packet, after_ms(10), Some("refused before")),
    ];
    all.add("a forged packet twice", "IEEE 1609.2 5.3.1", twice);
    let unsecured = heard(plain(Service::Ram, NOW, HERE), NOW, Some("not secured"));
    all.add(
        "a packet without an envelope",
        "TS 103 097 7.1",
        vec![unsecured],
    );
}

pub(crate) fn vectors() -> Vectors {
    let mut all = Vectors {
        pki: Pki::new(),
        all: Vec::new(),
    };
    taken(&mut all);
    profiles(&mut all);
    places_and_times(&mut all);
    certificates(&mut all);
    signatures(&mut all);
    all
}
