//! QEMU's virt board: a 32-bit RISC-V, a 16550 UART, and the clock of the CLINT at 10 MHz.

use core::arch::{asm, global_asm};

use super::{read, write};

global_asm!(
    ".section .vectors, \"ax\"",
    ".global _start",
    "_start:",
    "la sp, _stack_top",
    "la t0, _fault",
    "csrw mtvec, t0",
    "call main",
    ".align 4",
    "_fault:",
    "call fault",
);

const UART: usize = 0x1000_0000;
const UART_INTERRUPT: usize = UART + 1;
const UART_FIFO: usize = UART + 2;
const UART_STATE: usize = UART + 5;
/// The timer of the first hart.
const TIMER: usize = 0x0200_4000;
const TIME: usize = 0x0200_BFF8;
const PLIC: usize = 0x0C00_0000;
const PLIC_ENABLE: usize = PLIC + 0x2000;
const PLIC_CLAIM: usize = PLIC + 0x20_0004;
/// The UART's number at the PLIC.
const UART_SOURCE: u32 = 10;
const CLOCKS_PER_US: u64 = 10;

/// The name of the board.
pub(crate) const NAME: &str = "RV32IMAC (QEMU virt)";

/// The UART, the clock, and what ends a rest.
pub(crate) struct Board;

impl Board {
    pub(crate) fn start() -> Self {
        write(UART_FIFO, 1_u8);
        write(UART_INTERRUPT, 1_u8);
        write(PLIC + 4 * UART_SOURCE as usize, 1_u32);
        write(PLIC_ENABLE, 1_u32 << UART_SOURCE);
        // Timer and external interrupts end a rest; none is taken, since they are off as a whole.
        // SAFETY: no memory is changed.
        unsafe { asm!("csrs mie, {}", in(reg) 0x880, options(nomem, nostack)) };
        Self
    }

    fn clocks() -> u64 {
        loop {
            let (high, low): (u32, u32) = (read(TIME + 4), read(TIME));
            if read::<u32>(TIME + 4) == high {
                return u64::from(high) << 32 | u64::from(low);
            }
        }
    }

    pub(crate) fn now_us(&mut self) -> u64 {
        Self::clocks() / CLOCKS_PER_US
    }

    pub(crate) fn instructions(&mut self) -> u64 {
        let low: u32;
        // SAFETY: no memory is changed.
        unsafe { asm!("csrr {}, minstret", out(reg) low, options(nomem, nostack)) };
        u64::from(low)
    }

    pub(crate) fn get(&mut self) -> Option<u8> {
        (read::<u8>(UART_STATE) & 1 != 0).then(|| read(UART))
    }

    pub(crate) fn put(&mut self, octet: u8) {
        while read::<u8>(UART_STATE) & 0x20 == 0 {}
        write(UART, octet);
    }

    /// Sleeps until something was received, or a millisecond has passed.
    pub(crate) fn rest(&mut self) {
        let until = Self::clocks() + 1_000 * CLOCKS_PER_US;
        write(TIMER + 4, u32::MAX);
        #[allow(clippy::cast_possible_truncation)]
        write(TIMER, until as u32);
        #[allow(clippy::cast_possible_truncation)]
        write(TIMER + 4, (until >> 32) as u32);
        // SAFETY: it changes no memory. An interrupt that is not taken ends it as well.
        unsafe { asm!("wfi", options(nomem, nostack)) };
        let claimed: u32 = read(PLIC_CLAIM);
        if claimed != 0 {
            write(PLIC_CLAIM, claimed);
        }
    }
}
