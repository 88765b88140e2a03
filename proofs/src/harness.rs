//! Harnesses, for Kani and for everybody else.

/// One harness.
#[derive(Clone, Copy, Debug)]
pub struct Harness {
    /// Its path, with that of the crate.
    pub path: &'static str,
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

/// Declares the harnesses of a module: functions with the bound of their loops and perhaps a
/// function that takes the place of another one, or with the reason why they are not proved.
///
/// Under Kani each is a `#[kani::proof]`, or left out if it is not proved; otherwise it is a function,
/// and the module has a table of them.
macro_rules! harnesses {
    ($(
        $(#[doc = $doc:expr])*
        $(
            #[unwind($unwind:literal)]
            $(#[stub($($stub:tt)*)])*
        )?
        $(#[random_only($reason:literal)])?
        fn $name:ident() $body:block
    )*) => {
        $(
            $(#[doc = $doc])*
            $(
                #[cfg_attr(all(kani, not(feature = "stand-in")), ::kani::proof)]
                #[cfg_attr(all(kani, not(feature = "stand-in")), ::kani::unwind($unwind))]
                #[cfg_attr(all(kani, not(feature = "stand-in")), ::kani::solver(cadical))]
                $(#[cfg_attr(all(kani, not(feature = "stand-in")), ::kani::stub($($stub)*))])*
            )?
            $(
                #[doc = concat!("\nOnly with random values: ", $reason)]
                #[cfg(not(all(kani, not(feature = "stand-in"))))]
            )?
            pub fn $name() $body
        )*

        /// The harnesses of this module.
        #[cfg(not(all(kani, not(feature = "stand-in"))))]
        pub(crate) const HARNESSES: &[$crate::Harness] = &[$(
            $crate::Harness {
                path: concat!(module_path!(), "::", stringify!($name)),
                run: $name,
            },
        )*];
    };
}

/// Declares harnesses with the same bound of their loops, each by what it does.
macro_rules! cases {
    ($unwind:literal; $(
        $(#[doc = $doc:literal])*
        $(#[random_only($reason:literal)])?
        $name:ident => $case:expr;
    )+) => {
        $crate::harness::harnesses! { $(
            $(#[doc = $doc])*
            #[unwind($unwind)]
            $(#[random_only($reason)])?
            fn $name() {
                $case;
            }
        )+ }
    };
}

pub(crate) use {cases, harnesses};
