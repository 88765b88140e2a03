//! What a harness is, for Kani and for everybody else.

/// One harness.
#[derive(Clone, Copy, Debug)]
pub struct Harness {
    /// Its path, with that of the crate.
    pub path: &'static str,
    /// How often Kani unwinds each loop.
    pub unwind: u32,
    /// The SAT solver that Kani uses.
    pub solver: &'static str,
    /// The harness.
    pub run: fn(),
}

impl Harness {
    /// Its name, as `cargo kani --harness` takes it.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.path
            .split_once("::")
            .map_or(self.path, |(_crate, name)| name)
    }
}

/// Declares the harnesses of a module: functions with the bound of their loops and their solver, and
/// perhaps with a function that takes the place of another one.
///
/// Under Kani each is a `#[kani::proof]`; otherwise it is a function, and the module has a table of
/// them.
macro_rules! harnesses {
    ($(
        $(#[doc = $doc:literal])*
        #[unwind($unwind:literal)]
        #[solver($solver:ident)]
        $(#[stub($($stub:tt)*)])?
        fn $name:ident() $body:block
    )*) => {
        $(
            $(#[doc = $doc])*
            #[cfg_attr(all(kani, not(feature = "stand-in")), ::kani::proof)]
            #[cfg_attr(all(kani, not(feature = "stand-in")), ::kani::unwind($unwind))]
            #[cfg_attr(all(kani, not(feature = "stand-in")), ::kani::solver($solver))]
            $(#[cfg_attr(all(kani, not(feature = "stand-in")), ::kani::stub($($stub)*))])?
            pub fn $name() $body
        )*

        /// The harnesses of this module.
        #[cfg(not(all(kani, not(feature = "stand-in"))))]
        pub(crate) const HARNESSES: &[$crate::Harness] = &[$(
            $crate::Harness {
                path: concat!(module_path!(), "::", stringify!($name)),
                unwind: $unwind,
                solver: stringify!($solver),
                run: $name,
            },
        )*];
    };
}

pub(crate) use harnesses;
