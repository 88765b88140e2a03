//! Panic handler of a program without the standard library: it stops here.

use core::panic::PanicInfo;

/// Stays where it is. A watchdog resets the robot, whose body stops when the program does; a follower
/// whose program is gone is given up by its leader as any other that is lost.
#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
