//! `crossguard codec`.

use std::fs::File;
use std::io::{BufRead, BufReader, IsTerminal, Read, Write};
use std::path::{Path, PathBuf};

use crossguard_codec::Identifiers;
use crossguard_judge::readable::{self, Decoded};
use crossguard_judge::signature::Signatures;
use serde_json::json;

use super::listening::ListeningArguments;
use super::{Failure, print, print_json};

#[derive(clap::Subcommand)]
pub(super) enum Command {
    /// Print a message (RAM, RMCM, CAM, VAM, CPM) or a `GeoNetworking` packet with one as JSON.
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
        /// Each line is a message in hexadecimal digits; print one line for each. See below.
        #[arg(long, conflicts_with_all = ["hex", "binary"])]
        batch: bool,
        #[command(flatten)]
        listening: Box<ListeningArguments>,
    },
    /// Print the octets of a message or packet that is given as JSON, in hexadecimal digits.
    #[command(after_help = BATCH)]
    Encode {
        /// Read the JSON from this file; from standard input by default.
        #[arg(value_name = "FILE")]
        file: Option<PathBuf>,
        /// Write the octets themselves.
        #[arg(long)]
        binary: bool,
        /// Each line is a message as JSON; print one line for each. See below.
        #[arg(long, conflicts_with = "binary")]
        batch: bool,
        /// Take ports, messageIds and ITS-AIDs from [identifiers] in this file, that of a robot or one with
        /// nothing else.
        #[arg(long, value_name = "FILE")]
        config: Option<PathBuf>,
    },
}

const EXAMPLES: &str = "Examples:\n  crossguard codec decode --hex 01f0...\n  \
    crossguard codec decode message.bin --binary\n  \
    crossguard codec decode < message.hex | crossguard codec encode\n  \
    crossguard codec decode --batch messages.hex > messages.jsonl\n\n\
    With --batch a line that is no message is printed as {\"line\": NUMBER, \"error\": CAUSE}, and told on standard \
    error; at the end the exit code is 2. Empty lines are passed over. Signatures are verified with --trust \
    only, as of the time when they were made.";

const BATCH: &str = "A component with a DEFAULT may be left out. With --batch a line that is no message is \
    printed as an empty line, and told with its number on standard error; at the end the exit code is 2. Empty \
    lines are passed over.";

pub(super) fn run(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Decode {
            file,
            hex,
            binary,
            batch,
            listening,
        } => {
            let mut decoder = Decoder {
                identifiers: listening.identifiers()?,
                signatures: listening.signatures()?,
            };
            if *batch {
                return decoder.batch(file.as_deref());
            }
            let octets = match hex {
                Some(digits) => from_hex(digits.as_bytes())?,
                None if *binary => read(file.as_deref())?,
                None => from_hex(&read(file.as_deref())?)?,
            };
            print_json(&decoder.decode(&octets)?)
        }
        Command::Encode {
            file,
            binary,
            batch,
            config,
        } => {
            let identifiers = super::listening::identifiers_of(config.as_deref())?;
            if *batch {
                let encoded = |line: &[u8]| encode(&identifiers, line).map(hex::encode);
                return convert_lines(open(file.as_deref())?, encoded, |_, _| String::new());
            }
            let octets = encode(&identifiers, &read(file.as_deref())?)?;
            if *binary {
                return Ok(std::io::stdout().write_all(&octets)?);
            }
            print(hex::encode(octets))
        }
    }
}

/// Reads messages of one channel.
struct Decoder {
    identifiers: Identifiers,
    signatures: Signatures,
}

impl Decoder {
    fn decode(&mut self, octets: &[u8]) -> Result<Decoded, Failure> {
        Decoded::of(&self.identifiers, &mut self.signatures, octets).map_err(Failure::input)
    }

    fn batch(&mut self, file: Option<&Path>) -> Result<(), Failure> {
        let error = |line, error: &str| json!({ "line": line, "error": error }).to_string();
        let decoded = |line: &[u8]| {
            let decoded = from_hex(line).and_then(|octets| self.decode(&octets))?;
            serde_json::to_string(&decoded).map_err(Failure::input)
        };
        convert_lines(open(file)?, decoded, error)
    }
}

fn encode(identifiers: &Identifiers, json: &[u8]) -> Result<Vec<u8>, Failure> {
    readable::encode(identifiers, json).map_err(Failure::input)
}

/// Prints what each line is converted to, or what `on_error` makes of its number and of what is wrong with it.
fn convert_lines(
    input: Box<dyn BufRead>,
    mut convert: impl FnMut(&[u8]) -> Result<String, Failure>,
    on_error: impl Fn(usize, &str) -> String,
) -> Result<(), Failure> {
    let (mut lines, mut bad) = (0, 0);
    for (place, line) in crossguard_robot::lines::lines(input).enumerate() {
        let line = line.map_err(|error| Failure::Input(format!("line {}: {error}", place + 1)))?;
        if line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        lines += 1;
        match convert(&line) {
            Ok(result) => print(result)?,
            Err(Failure::Input(error)) => {
                bad += 1;
                let _ = writeln!(std::io::stderr(), "line {}: {error}", place + 1);
                print(on_error(place + 1, &error))?;
            }
            Err(other) => return Err(other),
        }
    }
    if bad > 0 {
        return Err(Failure::Input(format!("{bad} of {lines} lines are bad")));
    }
    Ok(())
}

/// The input, which is a file or what is piped in.
fn open(file: Option<&Path>) -> Result<Box<dyn BufRead>, Failure> {
    if let Some(path) = file {
        let file = File::open(path).map_err(Failure::at(path))?;
        return Ok(Box::new(BufReader::new(file)));
    }
    if std::io::stdin().is_terminal() {
        return Err(Failure::Input(
            "nothing to read: name a file or pipe something in (see --help)".to_owned(),
        ));
    }
    Ok(Box::new(BufReader::new(std::io::stdin())))
}

fn read(file: Option<&Path>) -> Result<Vec<u8>, Failure> {
    let name = file.map_or_else(
        || "standard input".to_owned(),
        |path| path.display().to_string(),
    );
    let mut octets = Vec::new();
    let read = open(file)?.read_to_end(&mut octets);
    read.map_err(|error| Failure::Input(format!("{name}: {error}")))?;
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
