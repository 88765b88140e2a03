//! Secured messages: golden vectors, and everything that must not be believed.

mod golden;
mod hostile;
mod issuing;
mod pki;
mod pseudonyms;
mod receiving;
