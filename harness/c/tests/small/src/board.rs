//! The board: a serial line, a clock, and rest. Everything of the machine is here.

#[cfg(target_arch = "arm")]
mod cortex_m4;
#[cfg(target_arch = "riscv32")]
mod riscv;

#[cfg(target_arch = "arm")]
pub(crate) use cortex_m4::{Board, NAME};
#[cfg(target_arch = "riscv32")]
pub(crate) use riscv::{Board, NAME};

fn read<T>(address: usize) -> T {
    // SAFETY: it is a register of the board, of this width.
    unsafe { core::ptr::with_exposed_provenance::<T>(address).read_volatile() }
}

fn write<T>(address: usize, value: T) {
    // SAFETY: it is a register of the board, of this width.
    unsafe { core::ptr::with_exposed_provenance_mut::<T>(address).write_volatile(value) }
}

unsafe extern "C" {
    static _stack_bottom: u8;
}

/// How much of the stack a call takes.
pub(crate) struct Stack;

impl Stack {
    const PAINT: u8 = 0xA5;
    /// How much is painted: more than any call takes.
    const DEPTH: usize = 64 * 1024;
    /// What lies below the caller of `paint`, by which a figure may be too large.
    pub(crate) const MARGIN: usize = 256;

    /// Where the paint below `top` ends.
    fn end(top: usize) -> usize {
        let bottom = (&raw const _stack_bottom).expose_provenance();
        bottom.max(top - Self::DEPTH)
    }

    #[inline(never)]
    fn here() -> usize {
        let octet = 0_u8;
        (&raw const octet).expose_provenance()
    }

    /// Paints all of the stack below the caller; where that begins.
    #[inline(never)]
    pub(crate) fn paint() -> usize {
        let top = Self::here() - Self::MARGIN;
        for address in Self::end(top)..top {
            write(address, Self::PAINT);
        }
        top
    }

    /// How far below `top` the paint is gone.
    #[inline(never)]
    pub(crate) fn depth(top: usize) -> usize {
        let mut address = Self::end(top);
        while address < top && read::<u8>(address) == Self::PAINT {
            address += 1;
        }
        top - address + Self::MARGIN
    }
}
