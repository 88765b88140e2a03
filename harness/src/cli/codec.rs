//! `crossguard codec`.

use std::io::{IsTerminal, Read, Write};
use std::path::PathBuf;

use crossguard_codec::{Dictionary, Identifiers};
use crossguard_judge::readable::{self, Decoded};

use super::{Failure, print, print_json};

#[derive(clap::Subcommand)]
pub(super) enum Command {
    /// Print a message (RAM, RMCM, CAM, DENM, VAM, CPM) or a `GeoNetworking` packet with one as JSON.
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
        /// The common data dictionary that VAM and CPM are built on; no header tells.
        #[arg(long, value_enum, default_value = "2.4.1")]
        dictionary: Version,
    },
    /// Print the octets of a message or packet that is given as JSON, in hexadecimal digits.
    Encode {
        /// Read the JSON from this file; from standard input by default.
        #[arg(value_name = "FILE")]
        file: Option<PathBuf>,
        /// Write the octets themselves.
        #[arg(long)]
        binary: bool,
    },
}

/// A version of TS 102 894-2.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(super) enum Version {
    /// TS 103 300-3 v2.2.1, TS 103 324 v2.1.1 as published.
    #[value(name = "2.1.1")]
    V2_1_1,
    /// TS 103 300-3 v2.3.1; the same bits as 2.2.1 and 2.3.1.
    #[value(name = "2.4.1")]
    V2_4_1,
}

impl Version {
    pub(super) fn identifiers(self) -> Identifiers {
        Identifiers {
            dictionary: match self {
                Self::V2_1_1 => Dictionary::V2_1_1,
                Self::V2_4_1 => Dictionary::V2_4_1,
            },
            ..Identifiers::default()
        }
    }
}

const EXAMPLES: &str = "Examples:\n  crossguard codec decode --hex 01f0...\n  \
    crossguard codec decode message.bin --binary\n  \
    crossguard codec decode < message.hex | crossguard codec encode";

pub(super) fn run(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Decode {
            file,
            hex,
            binary,
            dictionary,
        } => {
            let octets = match hex {
                Some(digits) => from_hex(digits.as_bytes())?,
                None if *binary => read(file.as_ref())?,
                None => from_hex(&read(file.as_ref())?)?,
            };
            let decoded = Decoded::of(&dictionary.identifiers(), &octets);
            print_json(&decoded.map_err(Failure::input)?)
        }
        Command::Encode { file, binary } => encode(&read(file.as_ref())?, *binary),
    }
}

fn encode(json: &[u8], binary: bool) -> Result<(), Failure> {
    let octets = readable::encode(json).map_err(Failure::input)?;
    if binary {
        return Ok(std::io::stdout().write_all(&octets)?);
    }
    print(hex::encode(octets))
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
