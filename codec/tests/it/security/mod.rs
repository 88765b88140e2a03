//! Secured messages: golden vectors, and everything that must not be believed.

mod costs;
mod departures;
mod forge;
mod golden;
mod hostile;
mod issuing;
mod listed;
mod pki;
mod pseudonyms;
mod receiving;
mod revoking;
mod scene;
mod vectors;
