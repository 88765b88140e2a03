//! `crossguard codec`.

use std::io::{IsTerminal, Read, Write};
use std::path::PathBuf;

use crossguard_codec::{Identifiers, Message};
use serde::Serialize;

use super::{Failure, print, print_json};

#[derive(clap::Subcommand)]
pub(super) enum Command {
    /// Print a message as JSON.
    #[command(after_help = EXAMPLES)]
    Decode {
        /// Read the message from this file; from standard input by default.
        #[arg(value_name = "FILE")]
        file: Option<PathBuf>,
        /// The message, in hexadecimal digits.
        #[arg(long, value_name = "DIGITS", conflicts_with = "file")]
        hex: Option<String>,
        /// The input is the octets themselves, not hexadecimal digits.
        #[arg(long, conflicts_with = "hex")]
        binary: bool,
    },
    /// Print the octets of a message that is given as JSON, in hexadecimal digits.
    Encode {
        /// Read the JSON from this file; from standard input by default.
        #[arg(value_name = "FILE")]
        file: Option<PathBuf>,
        /// Write the octets themselves.
        #[arg(long)]
        binary: bool,
    },
}

const EXAMPLES: &str = "Examples:\n  crossguard codec decode --hex 01f0...\n  \
    crossguard codec decode message.bin --binary\n  \
    crossguard codec decode < message.hex | crossguard codec encode";

/// A message with what is known about its octets.
#[derive(Serialize)]
struct Decoded {
    octets: usize,
    /// How many parts had extension additions that this version does not know.
    #[serde(skip_serializing_if = "is_zero")]
    extended: usize,
    message: Message,
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde calls it with a reference"
)]
const fn is_zero(n: &usize) -> bool {
    *n == 0
}

pub(super) fn run(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Decode { file, hex, binary } => {
            let octets = match hex {
                Some(digits) => from_hex(digits.as_bytes())?,
                None if *binary => read(file.as_ref())?,
                None => from_hex(&read(file.as_ref())?)?,
            };
            decode(&octets)
        }
        Command::Encode { file, binary } => encode(&read(file.as_ref())?, *binary),
    }
}

fn decode(octets: &[u8]) -> Result<(), Failure> {
    let received = Message::decode(&Identifiers::default(), octets).map_err(Failure::input)?;
    let (octets, extended, message) = (octets.len(), received.extended, received.message);
    print_json(&Decoded {
        octets,
        extended,
        message,
    })
}

fn encode(json: &[u8], binary: bool) -> Result<(), Failure> {
    let octets = message_of(json)?
        .encode(&Identifiers::default())
        .map_err(Failure::input)?;
    if binary {
        return Ok(std::io::stdout().write_all(&octets)?);
    }
    print(hex::encode(octets))
}

/// The message in JSON, alone or as `decode` prints it.
fn message_of(json: &[u8]) -> Result<Message, Failure> {
    let value: serde_json::Value = serde_json::from_slice(json)
        .map_err(|error| Failure::Input(format!("not JSON: {error}")))?;
    let message = match value {
        serde_json::Value::Object(mut object) if object.contains_key("message") => {
            object.remove("message").unwrap_or_default()
        }
        other => other,
    };
    serde_json::from_value(message)
        .map_err(|error| Failure::Input(format!("not a message: {error}")))
}

fn read(file: Option<&PathBuf>) -> Result<Vec<u8>, Failure> {
    if let Some(path) = file {
        return std::fs::read(path)
            .map_err(|error| Failure::Input(format!("{}: {error}", path.display())));
    }
    let mut input = std::io::stdin();
    if input.is_terminal() {
        return Err(Failure::Input(
            "nothing to read: name a file or pipe something in (see --help)".to_owned(),
        ));
    }
    let mut octets = Vec::new();
    input
        .read_to_end(&mut octets)
        .map_err(|error| Failure::Input(format!("standard input: {error}")))?;
    Ok(octets)
}

/// Octets from hexadecimal digits; white space does not matter.
fn from_hex(text: &[u8]) -> Result<Vec<u8>, Failure> {
    let digits: Vec<u8> = text
        .iter()
        .copied()
        .filter(|c| !c.is_ascii_whitespace())
        .collect();
    hex::decode(&digits).map_err(|error| {
        Failure::Input(format!(
            "not hexadecimal digits: {error}; use --binary for octets"
        ))
    })
}
