//! A full channel, as an on-board unit measures it, holds the RAM of a moving robot back.

use std::io::Write;
use std::net::UdpSocket;
use std::os::unix::net::UnixStream;
use std::time::{Duration, Instant};

use crossguard_codec::core::ram::RAM;
use crossguard_codec::{Service, decode};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::station::Security;
use crossguard_robot::attachment::{Frame, Kind, Radio, Sends};
use crossguard_robot::boot;
use crossguard_robot::journal::{Journal, RECORDS, WhenFull};
use crossguard_robot::robot_file::RobotFile;
use crossguard_robot::runtime::Order;
use crossguard_robot::trace::Entry;
use crossguard_robot::transport::{Link, Transport};
use serde_json::json;

const PATIENCE: Duration = Duration::from_mins(2);

/// The shortest time between so many RAM, by the times in them, of a robot that changes its speed all the time, while its
/// unit says how busy the channel is and congestion control keeps this interval.
fn shortest_gap_ms(busy_permyriad: u16, interval_ms: u64, count: usize) -> u16 {
    let folder = tempfile::tempdir().unwrap();
    let unit = UdpSocket::bind("127.0.0.1:0").unwrap();
    unit.set_read_timeout(Some(PATIENCE)).unwrap();
    let address = unit.local_addr().unwrap();
    let path = folder.path().join("robot.toml");
    let text = format!(
        "name = \"R\"\nstation = 1\nbuild = \"wheeled\"\nboot_file = \"r.boot\"\n\
         [site]\nlatitude = 49.0\nlongitude = 8.4\n[body]\nlisten = \"unix:r.sock\"\nsilence_ms = 5000\n[link]\nunit = \"{address}\"\n"
    );
    std::fs::write(&path, text).unwrap();
    let file = RobotFile::read(&path).unwrap();
    let (unit_address, own, sends) = (address, None, Sends::GeoNetworking);
    let link = Link::Unit {
        unit: unit_address,
        address: own,
        sends,
    };
    assert_eq!(file.link, link);
    let body = file.body_or_port(1).unwrap();
    let mut moves = UnixStream::connect(folder.path().join("r.sock")).unwrap();
    writeln!(moves, "{{\"type\": \"hello\", \"crossguard\": 3}}").unwrap();
    let boot = boot::take(&file.boot_file).unwrap();
    let halves = link.open().unwrap();
    let mut journal = Journal::new();
    let records = journal.reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
    let setup = file.setup(boot, body, Security::default(), halves, journal);
    let running = setup.start();
    // It says hello.
    let (_, robot) = unit.recv_from(&mut [0; 2_048]).unwrap();
    let channel = Frame {
        radio: Radio {
            power_decidbm: None,
            busy_permyriad: Some(busy_permyriad),
        },
        ..Frame::new(Kind::Channel, &[])
    };
    let channel = channel.encode().unwrap();
    let deadline = Instant::now() + PATIENCE;
    let (mut sent_ms, mut is_settled, mut turn) = (Vec::new(), false, 0);
    while sent_ms.len() < count {
        assert!(Instant::now() < deadline, "{sent_ms:?} {is_settled}");
        if turn % 10 == 0 {
            unit.send_to(&channel, robot).unwrap();
        }
        turn += 1;
        let speed_mps = turn % 5;
        let pose = json!({"type": "pose", "eastM": 0, "northM": 0, "speedMps": speed_mps});
        writeln!(moves, "{pose}").unwrap();
        std::thread::sleep(Duration::from_millis(10));
        for record in records.try_iter() {
            match &record.entry {
                Entry::Channel(now) => {
                    is_settled = now.interval_ms == interval_ms;
                    sent_ms.retain(|_| is_settled);
                }
                Entry::Sent {
                    message: Service::Ram,
                    octets,
                    ..
                } if is_settled => {
                    let ram = decode::<RAM>(&file.identifiers, octets).unwrap().message;
                    sent_ms.push(ram.ram.generation_delta_time.0);
                }
                _ => {}
            }
        }
    }
    running.order(Order::Die);
    running.wait().unwrap();
    let gaps_ms = sent_ms.windows(2).map(|two| two[1].wrapping_sub(two[0]));
    gaps_ms.min().unwrap()
}

#[test]
fn a_moving_robot_sends_ten_ram_a_second_on_a_free_channel_and_one_on_a_full_one() {
    let [free_ms, full_ms] = [(0, 100, 30), (8_000, 1_000, 3)].map(|(busy, interval_ms, count)| {
        std::thread::spawn(move || shortest_gap_ms(busy, interval_ms, count))
    });
    let (free_ms, full_ms) = (free_ms.join().unwrap(), full_ms.join().unwrap());
    assert!((95..=150).contains(&free_ms), "{free_ms}");
    assert!(full_ms >= 950, "{full_ms}");
}
