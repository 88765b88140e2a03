//! A full channel, as an on-board unit measures it, holds the RAM of a moving robot back.

use std::io::Write;
use std::net::UdpSocket;
use std::os::unix::net::UnixStream;
use std::time::{Duration, Instant};

use crossguard_endpoint::station::Security;
use crossguard_robot::attachment::{Frame, Kind, Radio, Sends, Side};
use crossguard_robot::boot;
use crossguard_robot::journal::Journal;
use crossguard_robot::robot_file::RobotFile;
use crossguard_robot::runtime::Order;
use crossguard_robot::transport::{Link, Transport};
use serde_json::json;

/// For how long congestion control may settle, and for how long is counted after that.
const SETTLING: Duration = Duration::from_millis(1_500);
const COUNTED: Duration = Duration::from_secs(4);

/// How many packets a robot sends that changes its speed all the time, while its unit says that.
fn sent_at(busy_permyriad: u16) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let unit = UdpSocket::bind("127.0.0.1:0").unwrap();
    unit.set_read_timeout(Some(Duration::from_millis(10)))
        .unwrap();
    let address = unit.local_addr().unwrap();
    let path = folder.path().join("robot.toml");
    let text = format!(
        "name = \"R\"\nstation = 1\nbuild = \"wheeled\"\nboot_file = \"r.boot\"\n\
         [body]\nlisten = \"unix:r.sock\"\n[link]\nunit = \"{address}\"\n"
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
    writeln!(moves, "{{\"type\": \"hello\", \"crossguard\": 2}}").unwrap();
    let boot = boot::take(&file.boot_file).unwrap();
    let halves = link.open().unwrap();
    let setup = file.setup(boot, body, Security::default(), halves, Journal::new());
    let running = setup.start();
    let began = Instant::now();
    let (mut buffer, mut packets, mut turn) = ([0; 2_048], 0, 0);
    while began.elapsed() < SETTLING + COUNTED {
        turn += 1;
        let speed_mps = turn % 5;
        let pose = json!({"type": "pose", "eastM": 0, "northM": 0, "speedMps": speed_mps});
        writeln!(moves, "{pose}").unwrap();
        let Ok((length, robot)) = unit.recv_from(&mut buffer) else {
            continue;
        };
        let frame = Frame::decode(&buffer[..length], Side::Robot).unwrap();
        let is_counted = frame.kind == Kind::SendPacket && began.elapsed() > SETTLING;
        packets += usize::from(is_counted);
        let channel = Frame {
            radio: Radio {
                power_decidbm: None,
                busy_permyriad: Some(busy_permyriad),
            },
            ..Frame::new(Kind::Channel, &[])
        };
        unit.send_to(&channel.encode().unwrap(), robot).unwrap();
    }
    running.order(Order::Die);
    running.wait().unwrap();
    packets
}

#[test]
fn a_moving_robot_sends_ten_ram_a_second_on_a_free_channel_and_one_on_a_full_one() {
    let [free, full] = [0, 8_000].map(|busy| std::thread::spawn(move || sent_at(busy)));
    let (free, full) = (free.join().unwrap(), full.join().unwrap());
    // A machine that is busy itself sends fewer.
    assert!((20..=41).contains(&free), "{free} on a free channel");
    assert!((3..=5).contains(&full), "{full} on a full channel");
}
