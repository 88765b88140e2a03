//! RAM, RMCM and what other messages share with them, of the [core](crate::core) and of rasn, converted into each
//! other.
//!
//! The way from one to the other is the encoding, on which the two agree.

use super::{cdd, ram, rmcm};
use crate::core;
use crate::error::{DecodeError, EncodeError};

macro_rules! conversion {
    ($module:ident::$name:ident) => {
        impl TryFrom<&core::$module::$name> for $module::$name {
            type Error = DecodeError;

            fn try_from(value: &core::$module::$name) -> Result<Self, DecodeError> {
                let mut buffer = [0; core::max_octets::<core::$module::$name>()];
                let length = core::encode(value, &mut buffer);
                let length = length.map_err(DecodeError::of_core::<core::$module::$name>)?;
                Ok(super::decode(&buffer[..length])?.value)
            }
        }

        /// What the core does not take, no receiver does.
        impl TryFrom<&$module::$name> for core::$module::$name {
            type Error = EncodeError;

            fn try_from(value: &$module::$name) -> Result<Self, EncodeError> {
                let octets = super::encode(value)?;
                let (value, _) = core::decode(&octets).map_err(EncodeError::of_core::<Self>)?;
                Ok(value)
            }
        }
    };
}

conversion!(ram::RAM);
conversion!(rmcm::RMCM);
conversion!(cdd::BasicContainer);
conversion!(cdd::Shape);
