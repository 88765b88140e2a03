//! RAM and RMCM of the [core](crate::core) and of rasn, converted into each other, and the JSON view
//! of the core's, which is that of rasn's.
//!
//! The way from one to the other is the encoding, on which the two agree.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de, ser};

use super::{cdd, ram, rmcm};
use crate::core;
use crate::error::{DecodeError, EncodeError};
use crate::uper;

macro_rules! conversion {
    ($module:ident::$name:ident) => {
        impl TryFrom<&core::$module::$name> for $module::$name {
            type Error = DecodeError;

            fn try_from(value: &core::$module::$name) -> Result<Self, DecodeError> {
                let mut buffer = [0; core::max_octets::<core::$module::$name>()];
                let length = core::encode(value, &mut buffer);
                let length = length.map_err(DecodeError::of_core::<core::$module::$name>)?;
                rasn::uper::decode(&buffer[..length]).map_err(|_| DecodeError::Disagreement)
            }
        }

        /// What the core does not take, no receiver does.
        impl TryFrom<&$module::$name> for core::$module::$name {
            type Error = EncodeError;

            fn try_from(value: &$module::$name) -> Result<Self, EncodeError> {
                let octets = uper::encode(value)?;
                let (value, _) = core::decode(&octets).map_err(EncodeError::of_core::<Self>)?;
                Ok(value)
            }
        }
    };
}

macro_rules! json {
    ($module:ident::$name:ident) => {
        impl Serialize for core::$module::$name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let of_rasn = $module::$name::try_from(self).map_err(ser::Error::custom)?;
                of_rasn.serialize(serializer)
            }
        }

        impl<'de> Deserialize<'de> for core::$module::$name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let of_rasn = $module::$name::deserialize(deserializer)?;
                Self::try_from(&of_rasn).map_err(de::Error::custom)
            }
        }
    };
}

conversion!(ram::RAM);
conversion!(rmcm::RMCM);
conversion!(cdd::BasicContainer);

json!(ram::RAM);
json!(rmcm::RMCM);
