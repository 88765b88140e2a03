//! RAM, RMCM and what other messages share with them, of the [core](crate::core) and of rasn, converted into each
//! other.
//!
//! The way from one to the other is the encoding, on which the two agree.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de, ser};

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

        /// No receiver takes a message that the core does not take.
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

/// JSON of RAM and RMCM is that of the reference.
macro_rules! json {
    ($module:ident::$name:ident) => {
        impl Serialize for core::$module::$name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let message = $module::$name::try_from(self).map_err(ser::Error::custom)?;
                message.serialize(serializer)
            }
        }

        impl<'de> Deserialize<'de> for core::$module::$name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let message = $module::$name::deserialize(deserializer)?;
                Self::try_from(&message).map_err(de::Error::custom)
            }
        }
    };
}

json!(ram::RAM);
json!(rmcm::RMCM);
