//! Types of the common data dictionary.

use crossguard_codec::core::cdd::{
    BasicContainer, CircularShape, ItsPduHeader, MapReference, PathDeltaTimeChoice, PathPoint,
    SafeDistanceIndication,
};
use crossguard_codec::core::max_octets;

use super::{cuts, octets, values};
use crate::harness::harnesses;

harnesses! {
    /// All headers.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn header_comes_back() {
        values::<ItsPduHeader, { max_octets::<ItsPduHeader>() }>(|value| value.station_id.0 > 1);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(8)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn header_is_canonical() {
        octets::<ItsPduHeader, { max_octets::<ItsPduHeader>() }>();
    }

    /// All headers, and every cut.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn header_cut_short_is_refused() {
        cuts::<ItsPduHeader, { max_octets::<ItsPduHeader>() }>();
    }

    /// All basic containers.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn basic_container_comes_back() {
        values::<BasicContainer, { max_octets::<BasicContainer>() }>(|value| value.station_type.0 == 16);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(19)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn basic_container_is_canonical() {
        octets::<BasicContainer, { max_octets::<BasicContainer>() }>();
    }

    /// All references of a map.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn map_reference_comes_back() {
        values::<MapReference, { max_octets::<MapReference>() }>(|value| matches!(value, MapReference::Intersection(_)));
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(7)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn map_reference_is_canonical() {
        octets::<MapReference, { max_octets::<MapReference>() }>();
    }

    /// All points of a path.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn path_point_comes_back() {
        values::<PathPoint, { max_octets::<PathPoint>() }>(|value| value.path_delta_time.is_some());
    }

    /// All times of a predicted point.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn path_delta_time_comes_back() {
        values::<PathDeltaTimeChoice, { max_octets::<PathDeltaTimeChoice>() }>(|value| matches!(value, PathDeltaTimeChoice::DeltaTimeMidRange(_)));
    }

    /// All circles.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn circular_shape_comes_back() {
        values::<CircularShape, { max_octets::<CircularShape>() }>(|value| value.height.is_some());
    }

    /// All indications of a safe distance.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn safe_distance_comes_back() {
        values::<SafeDistanceIndication, { max_octets::<SafeDistanceIndication>() }>(|value| value.time_to_collision.is_some());
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(8)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn safe_distance_is_canonical() {
        octets::<SafeDistanceIndication, { max_octets::<SafeDistanceIndication>() }>();
    }
}
