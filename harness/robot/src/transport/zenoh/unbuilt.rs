//! What there is of zenoh in a program that was built without it.

use std::convert::Infallible;

use super::super::{Halves, LinkError};
use super::{Zenoh, ZenohError};

/// A session, of which there is none.
pub(super) type Session = Infallible;

/// There is no network to enter.
pub(super) fn open(part: &Zenoh) -> Result<Halves, LinkError> {
    enter(part).map(|(session, _)| match session {})
}

/// There is no network to enter.
pub(super) fn enter(_: &Zenoh) -> Result<(Session, bool), LinkError> {
    Err(ZenohError::NotBuilt.into())
}
