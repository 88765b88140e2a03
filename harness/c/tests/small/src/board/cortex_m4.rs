//! QEMU's mps2-an386: a Cortex-M4 at 25 MHz, a CMSDK UART and a CMSDK timer.

use core::arch::{asm, global_asm};

use super::{read, write};

// Stack pointer, entry, and faults, then interrupts, none of which is ever taken: they only end a rest.
global_asm!(
    ".section .vectors, \"a\"",
    ".word _stack_top",
    ".word _start",
    ".rept 46",
    ".word _fault",
    ".endr",
    ".section .text._start, \"ax\"",
    ".global _start",
    ".type _start, %function",
    ".thumb_func",
    "_start:",
    // The floating-point unit is off after a reset.
    "ldr r0, =0xE000ED88",
    "ldr r1, =0x00F00000",
    "str r1, [r0]",
    "dsb",
    "isb",
    "cpsid i",
    "bl main",
    ".type _fault, %function",
    ".thumb_func",
    "_fault:",
    "bl fault",
);

const UART: usize = 0x4000_4000;
const UART_STATE: usize = UART + 0x4;
const UART_CONTROL: usize = UART + 0x8;
const UART_INTERRUPT: usize = UART + 0xC;
const UART_BAUD: usize = UART + 0x10;
const TIMER: usize = 0x4000_0000;
const TIMER_RELOAD: usize = TIMER + 0x8;
const TIMER_INTERRUPT: usize = TIMER + 0xC;
const SYSTICK: usize = 0xE000_E010;
const INTERRUPTS_ENABLE: usize = 0xE000_E100;
const INTERRUPTS_CLEAR: usize = 0xE000_E280;
/// UART0 has received, and TIMER0 has run out.
const INTERRUPTS: u32 = 1 << 0 | 1 << 8;
const CLOCKS_PER_US: u32 = 25;
/// SysTick counts 24 bits down.
const COUNT_MAX: u32 = 0x00FF_FFFF;
/// With `-icount shift=0` an instruction takes 1 ns, and a clock 40 ns.
const INSTRUCTIONS_PER_CLOCK: u64 = 40;

/// The name of the board.
pub(crate) const NAME: &str = "Cortex-M4 (QEMU mps2-an386)";

/// The UART, the clock, and what ends a rest.
pub(crate) struct Board {
    last: u32,
    clocks: u64,
}

impl Board {
    pub(crate) fn start() -> Self {
        write(UART_BAUD, 16_u32);
        // Sends, receives, and interrupts when it has received.
        write(UART_CONTROL, 0b1011_u32);
        write(SYSTICK + 4, COUNT_MAX);
        write(SYSTICK + 8, 0_u32);
        write(SYSTICK, 0b101_u32);
        write(TIMER_RELOAD, 1_000 * CLOCKS_PER_US);
        write(TIMER, 0b1001_u32);
        write(INTERRUPTS_ENABLE, INTERRUPTS);
        Self {
            last: read(SYSTICK + 8),
            clocks: 0,
        }
    }

    /// To be called more often than twice a second, or time is lost.
    fn clocks(&mut self) -> u64 {
        let now: u32 = read(SYSTICK + 8);
        self.clocks += u64::from(self.last.wrapping_sub(now) & COUNT_MAX);
        self.last = now;
        self.clocks
    }

    pub(crate) fn now_us(&mut self) -> u64 {
        self.clocks() / u64::from(CLOCKS_PER_US)
    }

    pub(crate) fn instructions(&mut self) -> u64 {
        self.clocks() * INSTRUCTIONS_PER_CLOCK
    }

    pub(crate) fn get(&mut self) -> Option<u8> {
        let is_full = read::<u32>(UART_STATE) & 0b10 != 0;
        #[allow(clippy::cast_possible_truncation)]
        is_full.then(|| read::<u32>(UART) as u8)
    }

    pub(crate) fn put(&mut self, octet: u8) {
        while read::<u32>(UART_STATE) & 0b1 != 0 {}
        write(UART, u32::from(octet));
    }

    /// Sleeps until something was received, or a millisecond has passed.
    pub(crate) fn rest(&mut self) {
        // SAFETY: it changes no memory. An interrupt that is not taken ends it as well.
        unsafe { asm!("wfi", options(nomem, nostack)) };
        write(UART_INTERRUPT, 0b10_u32);
        write(TIMER_INTERRUPT, 0b1_u32);
        write(INTERRUPTS_CLEAR, INTERRUPTS);
    }
}
