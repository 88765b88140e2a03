//! Packets in pcap files, as the field's tools read them: each in an Ethernet frame of ethertype 0x8947,
//! which Wireshark takes apart down to BTP.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crossguard_codec::geonet::ethernet;
use pcap_file::PcapError;
use pcap_file::pcap::{PcapPacket, PcapReader, PcapWriter};

use crate::station::link_layer_of;
use crate::transport::{Arrival, Halves, NotSent, Receiver, Sender};

/// A file that packets are written to as they come and go. Clones write to the same file.
#[derive(Clone, Debug)]
pub struct Capture {
    state: Arc<Mutex<State>>,
}

#[derive(Debug)]
struct State {
    /// Without a buffer, so that nothing is missing when the process is killed.
    writer: PcapWriter<File>,
    /// The first thing that went wrong; nothing is written after it.
    failure: Option<PcapError>,
}

impl Capture {
    /// Creates the file.
    ///
    /// # Errors
    /// When it cannot be created or written to.
    pub fn create(path: &Path) -> Result<Self, PcapError> {
        let writer = PcapWriter::new(File::create(path).map_err(PcapError::IoError)?)?;
        let state = State {
            writer,
            failure: None,
        };
        Ok(Self {
            state: Arc::new(Mutex::new(state)),
        })
    }

    /// Writes a packet that is on the link now.
    pub fn record(&self, packet: &[u8]) {
        let frame = [&ethernet::header(link_layer_of(packet))[..], packet].concat();
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let now = now.unwrap_or(Duration::ZERO);
        let length = u32::try_from(frame.len()).unwrap_or(u32::MAX);
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.failure.is_none() {
            let written = state
                .writer
                .write_packet(&PcapPacket::new(now, length, &frame));
            state.failure = written.err();
        }
    }

    /// Whether everything was recorded.
    ///
    /// # Errors
    /// The first thing that went wrong.
    pub fn finish(self) -> Result<(), PcapError> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.failure.take().map_or(Ok(()), Err)
    }

    /// `halves`, and what goes out over them is recorded.
    #[must_use]
    pub fn of_sent(&self, halves: Halves) -> Halves {
        let capture = self.clone();
        Halves {
            sender: Box::new(RecordingSender {
                inner: halves.sender,
                capture,
            }),
            receiver: halves.receiver,
        }
    }

    /// `halves`, and what goes out and comes in over them is recorded.
    #[must_use]
    pub fn of_all(&self, halves: Halves) -> Halves {
        let Halves { sender, receiver } = self.of_sent(halves);
        let capture = self.clone();
        let inner = receiver;
        Halves {
            sender,
            receiver: Box::new(RecordingReceiver { inner, capture }),
        }
    }
}

struct RecordingSender {
    inner: Box<dyn Sender>,
    capture: Capture,
}

impl Sender for RecordingSender {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        self.capture.record(octets);
        self.inner.send(octets)
    }
}

struct RecordingReceiver {
    inner: Box<dyn Receiver>,
    capture: Capture,
}

impl Receiver for RecordingReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        let arrival = self.inner.receive(at_most)?;
        if let Some(Arrival::Datagram { octets, .. }) = &arrival {
            self.capture.record(octets);
        }
        Ok(arrival)
    }
}

/// A packet of a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Captured {
    /// When it was on the link, since 1970.
    pub at: Duration,
    /// The packet.
    pub packet: Vec<u8>,
}

/// The `GeoNetworking` packets in the Ethernet frames of a pcap file; other frames are passed over.
///
/// # Errors
/// When the file cannot be read or is no pcap file.
pub fn read(
    path: &Path,
) -> Result<impl Iterator<Item = Result<Captured, PcapError>> + use<>, PcapError> {
    let file = File::open(path).map_err(PcapError::IoError)?;
    let mut reader = PcapReader::new(BufReader::new(file))?;
    Ok(std::iter::from_fn(move || {
        loop {
            let frame = match reader.next_packet()? {
                Ok(frame) => frame,
                Err(error) => return Some(Err(error)),
            };
            if let Some((_, packet)) = ethernet::packet(&frame.data) {
                return Some(Ok(Captured {
                    at: frame.timestamp,
                    packet: packet.to_vec(),
                }));
            }
        }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_recorded_can_be_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("some.pcap");
        let capture = Capture::create(&path).unwrap();
        let packets = [vec![0x11; 60], vec![1, 2, 3]];
        for packet in &packets {
            capture.record(packet);
        }
        capture.finish().unwrap();
        let again: Result<Vec<_>, _> = read(&path).unwrap().collect();
        let again: Vec<_> = again.unwrap().into_iter().map(|one| one.packet).collect();
        assert_eq!(again, packets);
    }

    #[test]
    fn what_is_no_pcap_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("none.pcap");
        std::fs::write(&path, b"not a capture, but a text that is long enough").unwrap();
        assert!(read(&path).is_err());
    }
}
