//! A robot whose key is in a token: an example of [`SigningKey`](crossguard_codec::security::SigningKey).
//!
//! ```console
//! export SOFTHSM2_CONF=$PWD/softhsm2.conf           # directories.tokendir = /somewhere/of/yours
//! softhsm2-util --init-token --free --label robots --so-pin 1234 --pin 5678
//! printf 5678 > pin && chmod 600 pin
//! cargo run -p crossguard-robot --example pkcs11 -- /usr/lib/softhsm/libsofthsm2.so robots pin Go2
//! ```
//!
//! The key pair is made in the token, an authority issues a ticket for its public key, and packets are signed with it
//! that another robot verifies. The PIN is read from a file: arguments can be seen by every process.

mod token;

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use crossguard_codec::security::issue::{self, Terms};
use crossguard_codec::security::{
    Duration, SignedMessage, SigningKey as _, Station, Ticket, Tolerances, Validity,
};
use crossguard_codec::{Identifiers, Part, Service};
use crossguard_robot::pki::{self, Pki};
use cryptoki::types::AuthPin;

use token::Token;

/// How many packets are signed.
const PACKETS: u32 = 100;

fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [module, label, pin, key] = &arguments[..] else {
        eprintln!("pkcs11 MODULE TOKEN PIN_FILE KEY");
        return ExitCode::from(2);
    };
    match run(Path::new(module), label, Path::new(pin), key) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("pkcs11: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(module: &Path, label: &str, pin: &Path, name: &str) -> Result<(), Box<dyn Error>> {
    let pin = std::fs::read_to_string(pin)?;
    let token = Token::open(module, label, &AuthPin::from(pin.trim()))?;
    let key = token.key(name)?;
    if key.can_be_read()? {
        return Err(format!("the token gives the key '{name}' away").into());
    }
    let (identifiers, now) = (Identifiers::default(), pki::now());
    let pki = Pki::for_a_day(&identifiers, now)?;
    let start = u32::try_from(now.0 / 1_000_000)?;
    let validity = Validity {
        start,
        duration: Duration::hours(1),
    };
    let permissions = pki::robot_permissions(&identifiers, &[Part::Help], None);
    let terms = Terms::of_ticket(validity, permissions);
    let Pki { authority, .. } = &pki;
    let holder = key.public_key();
    let certificate = issue::ticket(&authority.certificate, &authority.key, holder, &terms)?;
    println!(
        "ticket {} is for key '{name}' in token '{label}'",
        certificate.id()
    );
    let tickets = vec![Ticket::new(certificate, key)?];
    let mut robot = Station::new(pki.trust()?, tickets, Tolerances::default(), now)?;
    let other = pki.credentials(&identifiers, (1, None), now)?;
    let mut other = Station::new(other.trust, other.tickets, Tolerances::default(), now)?;
    let its_aid = Service::Ram.its_aid(&identifiers);
    let began = Instant::now();
    for _ in 0..PACKETS {
        let envelope = robot.seal(now, its_aid, b"a packet")?;
        other.verify(now, None, &SignedMessage::decode(&envelope)?)?;
    }
    let each = began.elapsed() / PACKETS;
    println!("{PACKETS} packets signed by the token and verified, {each:.1?} each");
    token.log_out()?;
    match robot.seal(now, its_aid, b"a packet") {
        Ok(_) => Err("the token signs although nobody is logged in".into()),
        Err(error) => {
            println!("after the logout: {error}");
            Ok(())
        }
    }
}
