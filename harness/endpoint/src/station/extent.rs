//! How far the people that a message tells of may be from the place that it says, besides the error of that place.

use crossguard_codec::core::cdd::{CircularShape, Shape, StandardLength12b};
use crossguard_codec::{ConfidenceEllipse, Position, RoadUser};

use crate::ras::area;

/// The shape of a group that says none: its people are within 5 m of its head (`maxClusterDistance`, TS 103 300-3).
pub(super) const UNSAID: Shape = Shape::Circular(CircularShape {
    shape_reference_point: None,
    radius: StandardLength12b::saturating(50),
    height: None,
});

/// How far the people of a group are from its middle at most, in metres.
pub(super) fn extent_m(shape: Option<&Shape>) -> f64 {
    area::extent_m(shape.unwrap_or(&UNSAID))
}

/// The road user, who may be so many metres farther from the place that is said.
pub(super) fn widened(user: RoadUser, by_m: f64) -> RoadUser {
    let error_m = user.position.error_m() + by_m;
    let ellipse = ConfidenceEllipse {
        semi_major: error_m,
        semi_minor: error_m,
        orientation: 0.0,
    };
    let position = Position {
        ellipse: Some(ellipse),
        ..user.position
    };
    RoadUser { position, ..user }
}
