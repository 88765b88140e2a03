//! A robot whose key is in a token: `SoftHSM`, where it is installed.

#[path = "../examples/pkcs11/token.rs"]
mod token;

use std::path::{Path, PathBuf};
use std::process::Command;

use crossguard_codec::security::issue::{self, Terms};
use crossguard_codec::security::{
    Duration, KeyFailure, PrivateKey, SignedMessage, SigningKey, Station, Ticket, Time64,
    Tolerances, Unsigned, Validity,
};
use crossguard_codec::{Identifiers, Part, Service};
use crossguard_robot::pki::{self, Pki};
use cryptoki::types::AuthPin;
use token::{Token, TokenError};

/// 2026-01-05, in seconds since 2004.
const NOW_S: u32 = 694_694_401;
const NOW: Time64 = Time64(NOW_S as u64 * 1_000_000);
const PIN: &str = "5678";

/// The module of `SoftHSM`, where Debian and Fedora have it.
fn module() -> Option<PathBuf> {
    let places = [
        "/usr/lib/softhsm/libsofthsm2.so",
        "/usr/lib64/pkcs11/libsofthsm2.so",
    ];
    let mut places = places.iter().map(PathBuf::from);
    places.find(|place| place.is_file())
}

/// `SoftHSM` takes its tokens from where its environment says, so the test is another process.
#[test]
fn a_key_in_a_token_signs_and_does_not_leave_it() {
    if module().is_none()
        || Command::new("softhsm2-util")
            .arg("--version")
            .output()
            .is_err()
    {
        println!("SKIPPED a_key_in_a_token_signs_and_does_not_leave_it: there is no softhsm2");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let (tokens, conf) = (
        folder.path().join("tokens"),
        folder.path().join("softhsm2.conf"),
    );
    std::fs::create_dir(&tokens).unwrap();
    std::fs::write(
        &conf,
        format!("directories.tokendir = {}\n", tokens.display()),
    )
    .unwrap();
    let init = [
        "--init-token",
        "--free",
        "--label",
        "robots",
        "--so-pin",
        "1234",
        "--pin",
        PIN,
    ];
    let made = Command::new("softhsm2-util")
        .args(init)
        .env("SOFTHSM2_CONF", &conf)
        .output()
        .unwrap();
    assert!(made.status.success(), "{made:?}");
    // What it keeps is read by nobody else either.
    let mut inside = Command::new(std::env::current_exe().unwrap());
    inside.args(["--exact", "inside", "--ignored", "--nocapture"]);
    let output = inside.env("SOFTHSM2_CONF", &conf).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success(),
        "{said}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(said.contains("1 passed"), "{said}");
}

fn valid_for(duration: Duration) -> Validity {
    Validity {
        start: NOW_S,
        duration,
    }
}

/// A ticket for the holder of a public key.
fn ticket(pki: &Pki, key: impl SigningKey + 'static) -> Result<Ticket, Unsigned> {
    let permissions = pki::robot_permissions(&Identifiers::default(), &[Part::Help], None);
    let terms = Terms::of_ticket(valid_for(Duration::hours(1)), permissions);
    let (authority, holder) = (&pki.authority, key.public_key());
    let certificate = issue::ticket(&authority.certificate, &authority.key, holder, &terms);
    Ticket::new(certificate.unwrap(), key)
}

#[test]
#[ignore = "a_key_in_a_token_signs_and_does_not_leave_it runs it beside a token"]
fn inside() {
    let module: &Path = &module().expect("the other test has found it");
    let pin = AuthPin::from(PIN);
    let nobody = Token::open(module, "nobody", &pin).err().unwrap();
    assert!(matches!(nobody, TokenError::NoToken(_)), "{nobody}");
    let token = Token::open(module, "robots", &pin).unwrap();
    let key = token.key("Go2").unwrap();
    assert!(!key.can_be_read().unwrap());
    let again = token.key("Go2").unwrap().public_key();
    assert_eq!(again, key.public_key(), "it is made once");
    assert_ne!(token.key("ARI").unwrap().public_key(), key.public_key());
    assert_eq!(format!("{key:?}"), "TokenKey");

    let identifiers = Identifiers::default();
    let pki = Pki::for_a_day(&identifiers, NOW).unwrap();
    let station = |ticket| {
        let trust = pki.trust().unwrap();
        Station::new(trust, vec![ticket], Tolerances::default(), NOW).unwrap()
    };
    let mut robot = station(ticket(&pki, key).unwrap());
    let mut other = station(ticket(&pki, PrivateKey::generate()).unwrap());
    let its_aid = Service::Ram.its_aid(&identifiers);
    for _ in 0..3 {
        let envelope = robot.seal(NOW, its_aid, b"a packet").unwrap();
        let message = SignedMessage::decode(&envelope).unwrap();
        assert_eq!(
            other.verify(NOW, None, &message).unwrap().signer,
            robot.pseudonym()
        );
    }
    // The authority's key may be in a token as well.
    let of_root = token.key("root").unwrap();
    let terms = Terms {
        name: Some("root in a token".to_owned()),
        issue_permissions: pki.root.certificate.content().issue_permissions.clone(),
        ..Terms::of_ticket(valid_for(Duration::years(1)), Vec::new())
    };
    issue::root(&of_root, &terms).unwrap();

    token.log_out().unwrap();
    let failed = robot.seal(NOW, its_aid, b"a packet").unwrap_err();
    let nobody = KeyFailure("nobody is logged in to the token");
    assert_eq!(failed, Unsigned::Key(nobody));
    assert!(issue::root(&of_root, &terms).is_err());
}
