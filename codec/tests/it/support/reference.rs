//! Messages of the reference, rasn, and those of the endpoint, for tests that compare the two.

use std::fmt::Debug;

use crossguard_codec::asn1::ram::RAM;
use crossguard_codec::asn1::rmcm::RMCM;
use crossguard_codec::{EncodeError, Pdu, core};

/// A message of the reference.
pub trait Reference: rasn::Encode + rasn::Decode + PartialEq + Debug {
    /// The same as the endpoint has it.
    type Message: Pdu + PartialEq + Debug;

    fn to_message(&self) -> Result<Self::Message, EncodeError>;

    fn of(message: &Self::Message) -> Self;
}

impl Reference for RAM {
    type Message = core::ram::RAM;

    fn to_message(&self) -> Result<Self::Message, EncodeError> {
        self.try_into()
    }

    fn of(message: &Self::Message) -> Self {
        message.try_into().expect("core and reference agree")
    }
}

impl Reference for RMCM {
    type Message = core::rmcm::RMCM;

    fn to_message(&self) -> Result<Self::Message, EncodeError> {
        self.try_into()
    }

    fn of(message: &Self::Message) -> Self {
        message.try_into().expect("core and reference agree")
    }
}
