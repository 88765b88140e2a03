//! Captures of others and of the kit, read: pcap and pcapng.

use std::fs::File;
use std::io::{self, BufReader, ErrorKind, Read, Seek};
use std::path::{Path, PathBuf};
use std::time::Duration;

use pcap_file::pcap::PcapReader;
use pcap_file::pcapng::blocks::interface_description::{
    InterfaceDescriptionBlock, InterfaceDescriptionOption,
};
use pcap_file::pcapng::{Block, PcapNgReader};
use pcap_file::{DataLink, PcapError};

use super::link;

/// How a file of pcapng begins.
const PCAPNG: [u8; 4] = [0x0a, 0x0d, 0x0d, 0x0a];

/// A packet of a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Captured {
    /// When it was on the link, since 1970.
    pub at: Duration,
    /// The packet.
    pub packet: Vec<u8>,
}

/// Why a capture cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum NoCapture {
    /// There is no such file.
    #[error("no such file: {}", .0.display())]
    Missing(PathBuf),
    /// The file cannot be read.
    #[error("{}: {cause}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// It ends before its last packet does.
    #[error("{}: no capture, or it ends within a packet", .0.display())]
    CutOff(PathBuf),
    /// It has frames of a link layer in which no packets are found.
    #[error(
        "{}: {frames} frames of {link} were passed over: packets are found in frames of Ethernet, IEEE802_11, \
         IEEE802_11_RADIOTAP, LINUX_SLL, LINUX_SLL2, RAW, IPV4 and IPV6",
        path.display()
    )]
    OtherLink {
        /// The file.
        path: PathBuf,
        /// The name of the link layer, or its number.
        link: String,
        /// How many frames there are of such layers.
        frames: u64,
    },
    /// It is no capture, or a damaged one.
    #[error("{}: neither pcap nor pcapng, or damaged: {cause}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Fault of the file.
        cause: PcapError,
    },
}

impl NoCapture {
    fn file(path: &Path, cause: io::Error) -> Self {
        match cause.kind() {
            ErrorKind::NotFound => Self::Missing(path.to_owned()),
            ErrorKind::UnexpectedEof => Self::CutOff(path.to_owned()),
            _ => Self::File {
                path: path.to_owned(),
                cause,
            },
        }
    }

    fn pcap(path: &Path, cause: PcapError) -> Self {
        match cause {
            PcapError::IoError(cause) => Self::file(path, cause),
            PcapError::IncompleteBuffer => Self::CutOff(path.to_owned()),
            cause => Self::Damaged {
                path: path.to_owned(),
                cause,
            },
        }
    }
}

/// The `GeoNetworking` packets in the frames of a file in pcap or pcapng; other frames are passed over.
///
/// # Errors
/// When the file cannot be read or is no capture; at its end, when it has frames of a link layer that is not read.
pub fn read(
    path: &Path,
) -> Result<impl Iterator<Item = Result<Captured, NoCapture>> + use<>, NoCapture> {
    let path = path.to_owned();
    let mut frames = Frames::open(&path)?;
    let mut passed_over = None;
    Ok(std::iter::from_fn(move || {
        while let Some(frame) = frames.next() {
            let (at, link, frame) = match frame {
                Ok(frame) => frame,
                Err(error) => return Some(Err(NoCapture::pcap(&path, error))),
            };
            let Some(packet) = link::reader_of(link) else {
                passed_over.get_or_insert((link, 0)).1 += 1;
                continue;
            };
            if let Some(packet) = packet(&frame) {
                let packet = packet.to_vec();
                return Some(Ok(Captured { at, packet }));
            }
        }
        let (link, frames) = passed_over.take()?;
        Some(Err(NoCapture::OtherLink {
            path: path.clone(),
            link: format!("{link:?}"),
            frames,
        }))
    }))
}

/// A frame, its link layer, and when it was on the link.
type CapturedFrame = (Duration, DataLink, Vec<u8>);

/// The frames of a file.
enum Frames {
    Pcap(PcapReader<BufReader<File>>),
    PcapNg(Box<PcapNgReader<BufReader<File>>>),
}

impl Frames {
    fn open(path: &Path) -> Result<Self, NoCapture> {
        let of_file = |cause| NoCapture::file(path, cause);
        let mut file = File::open(path).map_err(of_file)?;
        let mut start = Vec::new();
        let taken = file.by_ref().take(4).read_to_end(&mut start);
        taken.map_err(of_file)?;
        file.rewind().map_err(of_file)?;
        let file = BufReader::new(file);
        let frames = if start == PCAPNG {
            PcapNgReader::new(file).map(|reader| Self::PcapNg(Box::new(reader)))
        } else {
            PcapReader::new(file).map(Self::Pcap)
        };
        frames.map_err(|cause| NoCapture::pcap(path, cause))
    }

    fn next(&mut self) -> Option<Result<CapturedFrame, PcapError>> {
        match self {
            Self::Pcap(reader) => {
                let link = reader.header().datalink;
                let packet = reader.next_packet()?;
                Some(packet.map(|packet| (packet.timestamp, link, packet.data.to_vec())))
            }
            Self::PcapNg(reader) => next_of_pcapng(reader),
        }
    }
}

/// The next frame of a pcapng file, which has blocks of other kinds.
fn next_of_pcapng(
    reader: &mut PcapNgReader<impl Read>,
) -> Option<Result<CapturedFrame, PcapError>> {
    loop {
        let (interface, ticks, frame) = match reader.next_block()? {
            // Its reader takes the ticks of the clock for nanoseconds.
            Ok(Block::EnhancedPacket(block)) => (
                block.interface_id,
                block.timestamp.as_nanos(),
                block.data.to_vec(),
            ),
            Ok(_) => continue,
            Err(error) => return Some(Err(error)),
        };
        let of = reader.interfaces().get(interface as usize);
        let interface = of.ok_or(PcapError::InvalidInterfaceId(interface));
        return Some(interface.map(|of| (time_of(ticks, of), of.linktype, frame)));
    }
}

/// The time since 1970 that the clock of an interface shows (pcapng, `if_tsresol` and `if_tsoffset`).
fn time_of(ticks: u128, link: &InterfaceDescriptionBlock<'_>) -> Duration {
    let (mut resolution, mut offset_s) = (6, 0);
    for option in &link.options {
        match option {
            InterfaceDescriptionOption::IfTsResol(value) => resolution = *value,
            InterfaceDescriptionOption::IfTsOffset(value) => offset_s = *value,
            _ => {}
        }
    }
    let exponent = u32::from(resolution & 0x7f);
    let base: u128 = if resolution & 0x80 == 0 { 10 } else { 2 };
    let per_second = base.checked_pow(exponent).unwrap_or(u128::MAX);
    let nanoseconds = ticks.saturating_mul(1_000_000_000) / per_second;
    let nanoseconds = u64::try_from(nanoseconds).unwrap_or(u64::MAX);
    Duration::from_nanos(nanoseconds).saturating_add(Duration::from_secs(offset_s))
}

#[cfg(test)]
mod tests {
    use std::borrow::Cow;

    use crossguard_codec::geonet::ethernet;
    use pcap_file::pcapng::PcapNgWriter;
    use pcap_file::pcapng::blocks::enhanced_packet::EnhancedPacketBlock;

    use super::*;

    fn interface(
        linktype: DataLink,
        options: Vec<InterfaceDescriptionOption<'static>>,
    ) -> InterfaceDescriptionBlock<'static> {
        InterfaceDescriptionBlock {
            linktype,
            snaplen: 0,
            options,
        }
    }

    #[test]
    fn the_clock_of_an_interface_says_what_its_ticks_are() {
        let shown = |ticks, options| time_of(ticks, &interface(DataLink::ETHERNET, options));
        let resolution = |value| vec![InterfaceDescriptionOption::IfTsResol(value)];
        assert_eq!(shown(1_500_000, vec![]), Duration::from_millis(1_500));
        assert_eq!(shown(1_500, resolution(3)), Duration::from_millis(1_500));
        assert_eq!(shown(1_500, resolution(9)), Duration::from_nanos(1_500));
        assert_eq!(shown(3, resolution(0x81)), Duration::from_millis(1_500));
        let later = vec![InterfaceDescriptionOption::IfTsOffset(7)];
        assert_eq!(shown(0, later), Duration::from_secs(7));
        assert_eq!(shown(1, resolution(0x7f)), Duration::ZERO);
    }

    #[test]
    fn frames_of_other_links_are_told_of_at_the_end() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("some.pcapng");
        let mut writer = PcapNgWriter::new(File::create(&path).unwrap()).unwrap();
        for linktype in [DataLink::ETHERNET, DataLink::USB_LINUX] {
            let options = vec![InterfaceDescriptionOption::IfTsResol(6)];
            writer
                .write_pcapng_block(interface(linktype, options))
                .unwrap();
        }
        let frame = [&ethernet::header([2, 0, 0, 0, 0, 1])[..], &[1, 2, 3]].concat();
        for interface_id in [0, 1] {
            let block = EnhancedPacketBlock {
                interface_id,
                // 2.5 s in ticks of a microsecond, which the writer takes for nanoseconds.
                timestamp: Duration::from_micros(2_500),
                original_len: 17,
                data: Cow::Borrowed(&frame),
                options: vec![],
            };
            writer.write_pcapng_block(block).unwrap();
        }
        let mut again = read(&path).unwrap();
        let packet = vec![1, 2, 3];
        let at = Duration::from_millis(2_500);
        assert_eq!(again.next().unwrap().unwrap(), Captured { at, packet });
        let error = again.next().unwrap().unwrap_err().to_string();
        assert!(
            error.contains("1 frames of USB_LINUX were passed over"),
            "{error}"
        );
        assert!(again.next().is_none());
    }

    #[test]
    fn what_is_wrong_with_a_file_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("none.pcap");
        let why = |path: &Path| read(path).err().map(|error| error.to_string());
        let missing = format!("no such file: {}", path.display());
        assert_eq!(why(&path), Some(missing));
        std::fs::write(&path, b"not a capture, but a text that is long enough").unwrap();
        let text = why(&path).unwrap();
        assert!(text.contains("neither pcap nor pcapng"), "{text}");
        std::fs::write(&path, []).unwrap();
        let text = why(&path).unwrap();
        assert!(text.contains("it ends within a packet"), "{text}");
    }
}
