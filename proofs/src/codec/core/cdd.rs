//! Types of the common data dictionary.

use crossguard_codec::core::cdd::{
    BasicContainer, CircularShape, ItsPduHeader, MapReference, PathDeltaTimeChoice, PathPoint,
    SafeDistanceIndication,
};

use super::containers;

containers! {
    comes_back {
        header_comes_back(ItsPduHeader, 2, |value| value.station_id.0 > 1);
        basic_container_comes_back(BasicContainer, 2, |value| value.station_type.0 == 16);
        map_reference_comes_back(MapReference, 2, |value| matches!(value, MapReference::Intersection(_)));
        path_point_comes_back(PathPoint, 2, |value| value.path_delta_time.is_some());
        path_delta_time_comes_back(PathDeltaTimeChoice, 2, |value| matches!(value, PathDeltaTimeChoice::DeltaTimeMidRange(_)));
        circular_shape_comes_back(CircularShape, 2, |value| value.height.is_some());
        safe_distance_comes_back(SafeDistanceIndication, 2, |value| value.time_to_collision.is_some());
    }
    is_canonical {
        header_is_canonical(ItsPduHeader, 8);
        basic_container_is_canonical(BasicContainer, 19);
        map_reference_is_canonical(MapReference, 7);
        safe_distance_is_canonical(SafeDistanceIndication, 8);
    }
    cut_short_is_refused {
        header_cut_short_is_refused(ItsPduHeader, 2);
    }
}
