//! A robot on a microcontroller: it leads or follows a crossing by packets over a serial line, or measures itself in a
//! crossing with a second robot in the same memory. `run` beside this crate builds it, and `bridge.py` is its outside.
#![no_std]
#![no_main]

mod board;
mod line;
mod station;

use core::fmt::Write as _;
use core::mem::MaybeUninit;

use crossguard::CrossguardStatus;

use board::{Board, NAME, Stack};
use line::{END, Frames, LOG, MISSION, PACKET, SAYS, send};
use station::{Call, Mission, Outside, Room, Station};

/// How long a crossing may take.
const PATIENCE_MS: u64 = 60_000;
/// How long a robot says farewell.
const FAREWELL_MS: u64 = 1_500;

/// All memory but the stack. Zeros are a value of it.
struct Memory {
    stations: [Station; 2],
    rooms: [Room; 2],
    frames: Frames,
    air: Air,
    under_way: [Packet; PACKETS],
}

static mut MEMORY: MaybeUninit<Memory> = MaybeUninit::zeroed();

#[unsafe(no_mangle)]
extern "C" fn main() -> ! {
    // SAFETY: nothing else refers to it, and zeros are a value of it.
    let memory = unsafe { (*(&raw mut MEMORY)).assume_init_mut() };
    let mut board = Board::start();
    say(&mut board, format_args!("{NAME}"));
    loop {
        let mission = match memory.frames.next(&mut board) {
            Some((MISSION, mission)) => read(mission),
            _ => None,
        };
        if let Some((mode, mission)) = mission {
            let is_done = if mode == b'm' {
                measure(memory, &mut board)
            } else {
                take_part(memory, &mut board, mission)
            };
            send(&mut board, END, &[u8::from(is_done)]);
        }
    }
}

/// A mission: `m`, `l` or `f` to measure, lead or follow; station id, boot counter, milliseconds since 1970.
fn read(octets: &[u8]) -> Option<(u8, Mission)> {
    let (&mode, octets) = octets.split_first()?;
    let (station, octets) = octets.split_first_chunk()?;
    let (boot, octets) = octets.split_first_chunk()?;
    let mission = Mission {
        leads: mode == b'l',
        station: u32::from_be_bytes(*station),
        boot: u16::from_be_bytes(*boot),
        unix_ms: u64::from_be_bytes(octets.try_into().ok()?),
    };
    Some((mode, mission))
}

/// The serial line, as the outside of a station.
struct Serial<'a>(&'a mut Board);

impl Outside for Serial<'_> {
    fn send(&mut self, packet: &[u8]) {
        send(self.0, PACKET, packet);
    }

    fn log(&mut self, lines: &[u8]) {
        send(self.0, LOG, lines);
    }
}

/// Takes part in a crossing. Whether it came to its end.
fn take_part(memory: &mut Memory, board: &mut Board, mission: Mission) -> bool {
    let Memory {
        stations: [station, _],
        rooms,
        frames,
        ..
    } = memory;
    let began_us = board.now_us();
    let mut over_ms = None;
    station.start(mission, (&raw mut rooms[0], true), &mut Serial(board));
    loop {
        let now_ms = (board.now_us() - began_us) / 1_000;
        if let Some((PACKET, packet)) = frames.next(board) {
            station.receive(now_ms, packet, &mut Serial(board));
        } else {
            board.rest();
        }
        station.live(now_ms, &mut Serial(board));
        if station.is_over() && over_ms.is_none() {
            over_ms = Some(now_ms);
        }
        let said_farewell = over_ms.is_some_and(|over_ms| now_ms - over_ms > FAREWELL_MS);
        if said_farewell || now_ms > PATIENCE_MS {
            station.stop(&mut Serial(board));
            return over_ms.is_some();
        }
    }
}

/// A packet, and how long it is.
type Packet = ([u8; 1_500], usize);
/// How many packets one call can have, and more than two robots send at once.
const PACKETS: usize = 8;

/// Packets on their way between two stations of one memory.
struct Air {
    packets: [Packet; PACKETS],
    count: usize,
}

/// What a kind of call took.
#[derive(Clone, Copy, Default)]
struct Cost {
    calls: u64,
    stack: usize,
    instructions: u64,
    instructions_max: u64,
}

/// The outside of a station whose calls are measured.
struct Measured<'a> {
    board: &'a mut Board,
    air: &'a mut Air,
    costs: &'a mut [Cost; 6],
}

impl Outside for Measured<'_> {
    fn send(&mut self, packet: &[u8]) {
        if let Some((place, length)) = self.air.packets.get_mut(self.air.count) {
            place[..packet.len()].copy_from_slice(packet);
            *length = packet.len();
            self.air.count += 1;
        }
    }

    fn log(&mut self, _: &[u8]) {}

    fn call(&mut self, kind: Call, call: &mut dyn FnMut() -> CrossguardStatus) {
        let cost = &mut self.costs[kind as usize];
        let top = Stack::paint();
        let before = self.board.instructions();
        let status = call();
        let took = self.board.instructions().saturating_sub(before);
        cost.stack = cost.stack.max(Stack::depth(top));
        cost.calls += 1;
        cost.instructions += took;
        cost.instructions_max = cost.instructions_max.max(took);
        station::check(status);
    }
}

/// Two stations cross by packets within one memory, and time in between is not waited for. Whether they came to the end.
fn measure(memory: &mut Memory, board: &mut Board) -> bool {
    let Memory {
        stations,
        rooms,
        air,
        under_way,
        ..
    } = memory;
    let mut costs = [Cost::default(); 6];
    for (station, it) in (1..).zip(stations.iter_mut()) {
        let room = &raw mut rooms[station as usize - 1];
        let mission = Mission {
            leads: station == 1,
            station,
            boot: 1,
            unix_ms: 1_790_000_000_000,
        };
        let costs = &mut costs;
        it.start(mission, (room, false), &mut Measured { board, air, costs });
    }
    let mut now_ms = 0;
    while now_ms < PATIENCE_MS && !stations.iter().all(Station::is_over) {
        now_ms += 10;
        let costs = &mut costs;
        for from in [0, 1] {
            stations[from].live(now_ms, &mut Measured { board, air, costs });
            let mut to = 1 - from;
            // Answers go back at once; nobody answers for ever.
            while air.count > 0 {
                let count = core::mem::take(&mut air.count);
                let (under_way, packets) = (&mut *under_way, &air.packets);
                under_way[..count].copy_from_slice(&packets[..count]);
                for (packet, length) in &under_way[..count] {
                    let outside = &mut Measured { board, air, costs };
                    stations[to].receive(now_ms, &packet[..*length], outside);
                }
                to = 1 - to;
            }
        }
    }
    say(
        board,
        format_args!("robot {}", size_of::<crossguard::CrossguardRobot>()),
    );
    for (name, cost) in Call::NAMES.into_iter().zip(costs) {
        let mean = cost.instructions / cost.calls.max(1);
        let Cost {
            calls,
            stack,
            instructions_max,
            ..
        } = cost;
        say(
            board,
            format_args!(
                "{name} calls {calls} stack {stack} instructions {mean} at-most {instructions_max}"
            ),
        );
    }
    stations.iter().all(Station::is_over)
}

/// Text for people, up to a line.
struct Text {
    octets: [u8; 160],
    length: usize,
}

impl core::fmt::Write for Text {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        for octet in text.bytes() {
            if let Some(place) = self.octets.get_mut(self.length) {
                *place = octet;
                self.length += 1;
            }
        }
        Ok(())
    }
}

fn say(board: &mut Board, text: core::fmt::Arguments<'_>) {
    let mut line = Text {
        octets: [0; 160],
        length: 0,
    };
    let _ = line.write_fmt(text);
    send(board, SAYS, &line.octets[..line.length]);
}

/// Says so, and stays where it is.
fn give_up(text: core::fmt::Arguments<'_>) -> ! {
    let mut board = Board::start();
    say(&mut board, text);
    send(&mut board, END, &[0]);
    loop {
        board.rest();
    }
}

#[unsafe(no_mangle)]
extern "C" fn fault() -> ! {
    give_up(format_args!("a fault of the processor"))
}
