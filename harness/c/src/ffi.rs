//! The boundary: the only module with unsafe code. It looks at pointers, lengths and the stamp in a
//! robot's memory, and hands on to safe code what it found to be right.
//!
//! A function never unwinds into its caller: a panic in an `extern "C"` function stops the process
//! (Rust reference, *Panic*), and without the standard library the panic handler does.
#![allow(unsafe_code, reason = "this is the boundary")]
#![allow(
    clippy::missing_safety_doc,
    reason = "what the caller owes is the contract of each pointer"
)]

use core::ffi::{CStr, c_char};
use core::mem::{MaybeUninit, align_of, offset_of, size_of};
use core::sync::atomic::{AtomicU32, Ordering};
use core::{ptr, slice};

use crate::abi::{
    CROSSGUARD_ABI_VERSION, CROSSGUARD_NONE_MS, CROSSGUARD_PACKETS_LEN, CrossguardBody,
    CrossguardConfig, CrossguardEvent, CrossguardRobot, CrossguardStatus, CrossguardTurn,
    CrossguardView,
};
use crate::body::NOBODY;
use crate::config::Refused;
use crate::counters::Text;
use crate::live::{Live, Turn, copy_text};
use crate::trace::Lines;

/// Head of a robot's memory.
#[repr(C)]
#[derive(Clone, Copy)]
struct Stamp {
    magic: u64,
    abi: u32,
    /// How large the library holds the robot to be, which differs from build to build.
    live_len: u32,
}

/// A robot's memory as the library sees it.
#[repr(C)]
struct Memory {
    stamp: Stamp,
    /// 1 while a call is in the robot: a second thread is refused.
    in_use: AtomicU32,
    live: MaybeUninit<Live>,
}

/// "xguardRB" of a robot that lives, and "xguardFI" of one that was finished.
const MAGIC_LIVE: u64 = u64::from_be_bytes(*b"xguardRB");
const MAGIC_FINISHED: u64 = u64::from_be_bytes(*b"xguardFI");
#[expect(
    clippy::cast_possible_truncation,
    reason = "it fits into a robot's memory"
)]
const LIVE_LEN: u32 = size_of::<Live>() as u32;

const _: () = assert!(size_of::<Memory>() <= size_of::<CrossguardRobot>());
const _: () = assert!(align_of::<Memory>() <= align_of::<CrossguardRobot>());
const _: () = assert!(offset_of!(Memory, stamp) == 0);

/// The type's value behind a pointer, for reading.
///
/// # Safety
/// A pointer that is neither null nor misaligned points to memory of `T` that nobody writes to
/// meanwhile. Every pattern of bits is a `T`.
unsafe fn read<'a, T>(pointer: *const T) -> Result<&'a T, CrossguardStatus> {
    check(pointer)?;
    // SAFETY: not null and aligned, and the rest is the caller's promise.
    Ok(unsafe { &*pointer })
}

/// The type's value behind a pointer, for writing.
///
/// # Safety
/// As for [`read`], and nobody else reads it either.
unsafe fn write<'a, T>(pointer: *mut T) -> Result<&'a mut T, CrossguardStatus> {
    check(pointer)?;
    // SAFETY: not null and aligned, and the rest is the caller's promise.
    Ok(unsafe { &mut *pointer })
}

fn check<T>(pointer: *const T) -> Result<(), CrossguardStatus> {
    if pointer.is_null() {
        return Err(CrossguardStatus::Null);
    }
    if !pointer.is_aligned() {
        return Err(CrossguardStatus::Misaligned);
    }
    Ok(())
}

/// The octets behind a pointer. Of no octets there need be no pointer.
///
/// # Safety
/// If it is not null, this many octets there may be read, and nobody writes to them meanwhile.
unsafe fn octets<'a>(pointer: *const u8, length: usize) -> Result<&'a [u8], CrossguardStatus> {
    if length == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(CrossguardStatus::Null);
    }
    if isize::try_from(length).is_err() {
        return Err(CrossguardStatus::BadArgument);
    }
    // SAFETY: not null, of octets every address is aligned, and the length is one of memory.
    Ok(unsafe { slice::from_raw_parts(pointer, length) })
}

/// The room behind a pointer.
///
/// # Safety
/// If it is not null, this many octets there may be written to, and nobody else reads them.
unsafe fn room<'a>(pointer: *mut u8, length: usize) -> Result<&'a mut [u8], CrossguardStatus> {
    if pointer.is_null() {
        return Err(CrossguardStatus::Null);
    }
    if isize::try_from(length).is_err() {
        return Err(CrossguardStatus::BadArgument);
    }
    // SAFETY: as for `octets`; the caller has initialised it or does not care what is in it.
    Ok(unsafe { slice::from_raw_parts_mut(pointer, length) })
}

/// A robot, for one call at a time.
struct Held<'a> {
    live: &'a mut Live,
    in_use: &'a AtomicU32,
}

impl Drop for Held<'_> {
    fn drop(&mut self) {
        self.in_use.store(0, Ordering::Release);
    }
}

/// The robot in some memory, if there is one that this library made, and no other call is in it.
///
/// # Safety
/// As for [`write`]. Memory whose first 16 octets are a stamp of this library was written by it, and
/// by nobody else since, other than by copying all of it.
unsafe fn live<'a>(robot: *mut CrossguardRobot) -> Result<Held<'a>, CrossguardStatus> {
    check(robot)?;
    let memory = robot.cast::<Memory>();
    // SAFETY: it points to a robot's memory, which is as large as `Memory` and aligned as it.
    let stamp = unsafe { (*memory).stamp };
    match stamp.magic {
        MAGIC_LIVE if stamp.abi != CROSSGUARD_ABI_VERSION || stamp.live_len != LIVE_LEN => {
            Err(CrossguardStatus::WrongVersion)
        }
        MAGIC_LIVE => {
            // SAFETY: every pattern of bits is such a number, and calls touch it in no other way.
            let in_use = unsafe { &(*memory).in_use };
            let free = in_use.compare_exchange(0, 1, Ordering::Acquire, Ordering::Relaxed);
            free.map_err(|_| CrossguardStatus::InUse)?;
            // SAFETY: the stamp is set last by `crossguard_robot_init`, when the robot is there, and
            // taken off first by `crossguard_robot_finish`; no other call has it.
            let live = unsafe { (*memory).live.assume_init_mut() };
            Ok(Held { live, in_use })
        }
        MAGIC_FINISHED => Err(CrossguardStatus::Finished),
        _ => Err(CrossguardStatus::NotInitialised),
    }
}

/// Does `act` with a robot and a turn, and says in the turn what came of it.
///
/// # Safety
/// As for [`try_with`].
unsafe fn with(
    robot: *mut CrossguardRobot,
    turn: *mut CrossguardTurn,
    act: impl FnOnce(&mut Live, &mut Turn<'_>),
) -> CrossguardStatus {
    let act = |live: &mut Live, turn: &mut Turn<'_>| {
        act(live, turn);
        CrossguardStatus::Ok
    };
    // SAFETY: the caller's promise.
    unsafe { try_with(robot, turn, act) }
}

/// As [`with`], for an `act` that may be refused.
///
/// # Safety
/// As for [`live`], [`write`], and [`room`] of the buffers that the turn names.
unsafe fn try_with(
    robot: *mut CrossguardRobot,
    turn: *mut CrossguardTurn,
    act: impl FnOnce(&mut Live, &mut Turn<'_>) -> CrossguardStatus,
) -> CrossguardStatus {
    let outcome = (|| {
        // SAFETY: the caller's promise.
        let plain = unsafe { write(turn)? };
        // A call that is refused leaves nothing of the last one to carry out.
        clear(plain);
        // SAFETY: the caller's promise.
        let held = unsafe { live(robot)? };
        // SAFETY: the caller's promise.
        let packets = unsafe { room(plain.packets, plain.packets_capacity)? };
        if packets.len() < CROSSGUARD_PACKETS_LEN {
            return Err(CrossguardStatus::ShortBuffer);
        }
        let log = if plain.log.is_null() {
            None
        } else {
            // SAFETY: the caller's promise.
            Some(unsafe { room(plain.log.cast(), plain.log_capacity)? })
        };
        let state = plain.body.to_state().ok_or(CrossguardStatus::BadArgument)?;
        let mut turn = Turn {
            plain,
            packets,
            lines: Lines::new(log),
            state,
        };
        let status = act(held.live, &mut turn);
        turn.plain.log_length = turn.lines.length();
        turn.plain.log_lost = turn.lines.lost();
        Ok(status)
    })();
    outcome.unwrap_or_else(|status| status)
}

fn clear(turn: &mut CrossguardTurn) {
    turn.packets_length = 0;
    turn.log_length = 0;
    turn.heard = NOBODY;
    turn.dropped[0] = 0;
    turn.outputs_length = 0;
    turn.log_lost = 0;
}

fn status(outcome: Result<(), CrossguardStatus>) -> CrossguardStatus {
    outcome.err().unwrap_or(CrossguardStatus::Ok)
}

/// The version of the interface that the library has; a program compares it with
/// `CROSSGUARD_ABI_VERSION` of its header.
#[unsafe(no_mangle)]
pub extern "C" fn crossguard_abi_version() -> u32 {
    CROSSGUARD_ABI_VERSION
}

/// Text of a status, in English. It is never null and lives as long as the program.
#[unsafe(no_mangle)]
pub extern "C" fn crossguard_status_text(status: u32) -> *const c_char {
    const TEXTS: [&CStr; 12] = [
        c"done",
        c"a pointer is null",
        c"a buffer is too short",
        c"header, library and robot are not of the same version",
        c"the robot was never initialised",
        c"the robot was finished",
        c"a pointer is not aligned",
        c"a code or number is out of range",
        c"the settings break an inequality, see crossguard_config_check",
        c"there is no more",
        c"the library was built without this",
        c"another call is in the robot",
    ];
    let text = TEXTS.get(status as usize).copied();
    text.unwrap_or(c"no status of this library").as_ptr()
}

/// Sets a configuration to the defaults of the protocol. Station id, boot counter and name are yours.
///
/// Errors: `Null`, `Misaligned`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_config_init(config: *mut CrossguardConfig) -> CrossguardStatus {
    // SAFETY: the contract of the pointer.
    status(unsafe { write(config) }.map(|config| *config = CrossguardConfig::standard()))
}

/// Checks a configuration. If it is refused and `why` is not null, that gets the reason as text that
/// ends with NUL, cut to `why_capacity` octets.
///
/// Errors: `Null`, `Misaligned`; `BrokenSettings` for an inequality between timers, `BadArgument` for
/// anything else that is refused.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_config_check(
    config: *const CrossguardConfig,
    why: *mut c_char,
    why_capacity: usize,
) -> CrossguardStatus {
    // SAFETY: the contract of the pointer.
    let config = match unsafe { read(config) } {
        Ok(config) => config,
        Err(status) => return status,
    };
    let Err(refused) = config.check() else {
        return CrossguardStatus::Ok;
    };
    if !why.is_null() {
        // SAFETY: the contract of the pointer.
        let room = unsafe { slice::from_raw_parts_mut(why, why_capacity.min(256)) };
        copy_text(Text::<256>::of(&refused).as_str(), room);
    }
    refused_as(&refused)
}

const fn refused_as(refused: &Refused) -> CrossguardStatus {
    match refused {
        Refused::Broken(_) => CrossguardStatus::BrokenSettings,
        Refused::Fallback | Refused::Identifiers(_) | Refused::Name => {
            CrossguardStatus::BadArgument
        }
    }
}

/// Sets a body to one that knows nothing of itself and steers itself.
///
/// Errors: `Null`, `Misaligned`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_body_init(body: *mut CrossguardBody) -> CrossguardStatus {
    // SAFETY: the contract of the pointer.
    status(unsafe { write(body) }.map(|body| *body = CrossguardBody::UNKNOWN))
}

/// Sets an event to one of this kind (`CrossguardEventKind`), with parameters that leave everything to
/// the follower.
///
/// Errors: `Null`, `Misaligned`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_event_init(
    event: *mut CrossguardEvent,
    kind: u8,
) -> CrossguardStatus {
    let new = CrossguardEvent {
        kind,
        urgency: 1,
        ..CrossguardEvent::default()
    };
    // SAFETY: the contract of the pointer.
    status(unsafe { write(event) }.map(|event| *event = new))
}

/// Sets a turn to one with these buffers and a body that knows nothing of itself. `log` may be null.
///
/// Errors: `Null`, `Misaligned`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_turn_init(
    turn: *mut CrossguardTurn,
    packets: *mut u8,
    packets_capacity: usize,
    log: *mut c_char,
    log_capacity: usize,
) -> CrossguardStatus {
    if let Err(status) = check(turn) {
        return status;
    }
    // SAFETY: it points to memory of a turn, for which zeros are a value.
    let turn = unsafe {
        ptr::write_bytes(turn, 0, 1);
        &mut *turn
    };
    turn.packets = packets;
    turn.packets_capacity = packets_capacity;
    turn.log = log;
    turn.log_capacity = log_capacity;
    turn.waited_ms = CROSSGUARD_NONE_MS;
    turn.body = CrossguardBody::UNKNOWN;
    turn.heard = NOBODY;
    CrossguardStatus::Ok
}

/// Starts a robot in the caller's memory: it has just booted, and is idle. `robot_len` is
/// `sizeof(CrossguardRobot)` and `abi_version` is `CROSSGUARD_ABI_VERSION`, both of the caller's header.
///
/// Errors: `Null`, `Misaligned`, `WrongVersion`, `ShortBuffer` if the memory is smaller than the
/// library needs, and those of `crossguard_config_check`. The memory is not touched then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_robot_init(
    robot: *mut CrossguardRobot,
    robot_len: usize,
    abi_version: u32,
    config: *const CrossguardConfig,
) -> CrossguardStatus {
    if let Err(status) = check(robot) {
        return status;
    }
    if abi_version != CROSSGUARD_ABI_VERSION {
        return CrossguardStatus::WrongVersion;
    }
    if robot_len < size_of::<CrossguardRobot>() {
        return CrossguardStatus::ShortBuffer;
    }
    // SAFETY: the contract of the pointer.
    let config = match unsafe { read(config) } {
        Ok(config) => config,
        Err(status) => return status,
    };
    let checked = match config.check() {
        Ok(checked) => checked,
        Err(refused) => return refused_as(&refused),
    };
    let memory = robot.cast::<Memory>();
    // SAFETY: it points to a robot's memory, which is as large as `Memory` and aligned as it.
    let memory = unsafe { &mut *memory };
    memory.in_use = AtomicU32::new(0);
    memory
        .live
        .write(Live::new(config.station, config.boot, checked));
    memory.stamp = Stamp {
        magic: MAGIC_LIVE,
        abi: CROSSGUARD_ABI_VERSION,
        live_len: LIVE_LEN,
    };
    CrossguardStatus::Ok
}

/// Ends a robot; it says no farewell. Its memory may then be given up or taken for another robot, and
/// until then every call with it returns `Finished`.
///
/// Errors: `Null`, `Misaligned`, `NotInitialised`, `Finished`, `WrongVersion`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_robot_finish(robot: *mut CrossguardRobot) -> CrossguardStatus {
    // SAFETY: the contract of the pointer.
    let held = match unsafe { live(robot) } {
        Ok(held) => held,
        Err(status) => return status,
    };
    // SAFETY: the memory is a robot's, and its stamp is taken off before what it stands for.
    unsafe {
        (*robot.cast::<Memory>()).stamp.magic = MAGIC_FINISHED;
        ptr::drop_in_place(ptr::from_mut(held.live));
    }
    CrossguardStatus::Ok
}

/// Tells a robot that `elapsed_ms` milliseconds have passed since it was told the last time. To be
/// called before every other input, and at the latest `delay_max_ms` after `next_due_ms` of its view.
///
/// Errors: `Null`, `Misaligned`, `NotInitialised`, `Finished`, `WrongVersion`, `ShortBuffer`,
/// `BadArgument` for a code in the body that is none, `InUse`. Nothing has happened then, and the turn has no outputs; the
/// time is yet to be told.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_elapse(
    robot: *mut CrossguardRobot,
    elapsed_ms: u32,
    turn: *mut CrossguardTurn,
) -> CrossguardStatus {
    // SAFETY: the contracts of the pointers.
    unsafe { with(robot, turn, |live, turn| live.elapse(elapsed_ms, turn)) }
}

/// Tells a robot what happened in it. An event that changes nothing is an output of kind `Ignored`.
///
/// Errors: as for `crossguard_elapse`; `BadArgument` also for a code in the event that is none, and
/// for parameters that name two targets.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_tell(
    robot: *mut CrossguardRobot,
    event: *const CrossguardEvent,
    turn: *mut CrossguardTurn,
) -> CrossguardStatus {
    // SAFETY: the contract of the pointer.
    let event = unsafe { read(event) };
    let act = |live: &mut Live, turn: &mut Turn<'_>| {
        match event.map(|event| event.to_protocol().zip(event.parameters.to_codec())) {
            Ok(Some((event, parameters))) => live.tell(event, parameters, turn),
            Ok(None) => return CrossguardStatus::BadArgument,
            Err(status) => return status,
        }
        CrossguardStatus::Ok
    };
    // SAFETY: the contracts of the pointers.
    unsafe { try_with(robot, turn, act) }
}

/// Hands a robot a `GeoNetworking` packet that was received. One that is dropped is not an error:
/// the turn's `dropped` says why, and it is counted.
///
/// Errors: as for `crossguard_elapse`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_receive(
    robot: *mut CrossguardRobot,
    packet: *const u8,
    packet_length: usize,
    turn: *mut CrossguardTurn,
) -> CrossguardStatus {
    // SAFETY: the contract of the pointer.
    let packet = unsafe { octets(packet, packet_length) };
    let act =
        |live: &mut Live, turn: &mut Turn<'_>| status(packet.map(|it| live.receive(it, turn)));
    // SAFETY: the contracts of the pointers.
    unsafe { try_with(robot, turn, act) }
}

/// Hands a robot a RAM or an RMCM that another stack took out of its packet: UPER, from the header on.
///
/// Errors: as for `crossguard_elapse`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_receive_message(
    robot: *mut CrossguardRobot,
    message: *const u8,
    message_length: usize,
    turn: *mut CrossguardTurn,
) -> CrossguardStatus {
    // SAFETY: the contract of the pointer.
    let message = unsafe { octets(message, message_length) };
    let act = |live: &mut Live, turn: &mut Turn<'_>| status(message.map(|it| live.hear(it, turn)));
    // SAFETY: the contracts of the pointers.
    unsafe { try_with(robot, turn, act) }
}

/// Makes a RAM outside of a session, where the protocol does not say when: `next_ram_ms` of the view is
/// `CROSSGUARD_NONE_MS`. To be called at least once a second and at most every 100 ms then. In a
/// session it does nothing.
///
/// Errors: as for `crossguard_elapse`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_announce(
    robot: *mut CrossguardRobot,
    turn: *mut CrossguardTurn,
) -> CrossguardStatus {
    // SAFETY: the contracts of the pointers.
    unsafe { with(robot, turn, Live::announce) }
}

/// Reads the state of a robot. The robot is not changed.
///
/// Errors: `Null`, `Misaligned`, `NotInitialised`, `Finished`, `WrongVersion`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_view(
    robot: *const CrossguardRobot,
    view: *mut CrossguardView,
) -> CrossguardStatus {
    // SAFETY: the contracts of the pointers; nothing is written to the robot.
    let both = unsafe { live(robot.cast_mut()).and_then(|held| Ok((held, write(view)?))) };
    status(both.map(|(held, view)| *view = CrossguardView::of(held.live.robot())))
}

/// Reads a count of dropped or ignored inputs: the cause number `index`, as text that ends with NUL, cut to
/// `name_capacity` octets, and how often it occurred. Causes are numbered from 0 as they first occur.
///
/// Errors: as for `crossguard_view`; `ShortBuffer` for a name without room, `End` behind the last.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_counter(
    robot: *const CrossguardRobot,
    index: usize,
    name: *mut c_char,
    name_capacity: usize,
    count: *mut u64,
) -> CrossguardStatus {
    // SAFETY: the contracts of the pointers; nothing is written to the robot.
    let all = unsafe {
        live(robot.cast_mut()).and_then(|held| {
            let count = write(count)?;
            check(name)?;
            let name = slice::from_raw_parts_mut(name, name_capacity.min(256));
            Ok((held, count, name))
        })
    };
    status(all.and_then(|(held, count, name)| {
        if name.is_empty() {
            return Err(CrossguardStatus::ShortBuffer);
        }
        let counted = held.live.counters().iter().nth(index);
        let (cause, times) = counted.ok_or(CrossguardStatus::End)?;
        copy_text(Text::<256>::of(&cause).as_str(), name);
        *count = times;
        Ok(())
    }))
}

/// Begins the log of a robot: its configuration. `unix_ms` are milliseconds since 1970 (UTC), to line up
/// logs of several robots. To be called once, before any other call with a log.
///
/// Errors: as for `crossguard_elapse`; `Unsupported` in a library that was built without logs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_log_start(
    robot: *mut CrossguardRobot,
    unix_ms: u64,
    turn: *mut CrossguardTurn,
) -> CrossguardStatus {
    if cfg!(not(feature = "trace")) {
        return CrossguardStatus::Unsupported;
    }
    // SAFETY: the contracts of the pointers.
    unsafe { with(robot, turn, |live, turn| live.start_log(unix_ms, turn)) }
}

/// Ends the log of a robot, with how often each cause occurred.
///
/// Errors: as for `crossguard_log_start`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn crossguard_log_stop(
    robot: *mut CrossguardRobot,
    turn: *mut CrossguardTurn,
) -> CrossguardStatus {
    if cfg!(not(feature = "trace")) {
        return CrossguardStatus::Unsupported;
    }
    // SAFETY: the contracts of the pointers.
    unsafe { with(robot, turn, Live::stop_log) }
}
