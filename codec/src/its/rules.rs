//! Limits of CAM and VAM that their encoding does not show, for senders and receivers alike.
//! Those of RAM and RMCM are in the types of the [core](crate::core); the encoding of a DENM shows all of
//! its own.
//!
//! - Sizes and values behind an extension marker are not used: a list of the common data dictionary
//!   has no more items than its root allows, so a message has a largest size. The decoder refuses
//!   them at the bit where they begin; here they are refused before they are encoded.
//! - An extension container that a CAM says to have has octets.
//! - The bounding box of a cluster is a rectangle, a circle or a polygon (TS 102 894-2,
//!   `VruClusterInformation`; an inner subtype constraint, which PER does not see).

use rasn::types::BitString;

use crate::asn1::cam::CAM;
use crate::asn1::cdd::{PathHistory, PathPoint, Shape, VruClusterInformation};
use crate::asn1::cdd211::VAM211;
use crate::asn1::vam::{VAM, VruMotionPredictionContainer};
use crate::error::BrokenRule;

pub(super) type Checked = Result<(), BrokenRule>;

fn at_most(field: &'static str, found: usize, max: usize) -> Checked {
    if found > max {
        return Err(BrokenRule::TooMany { field, found, max });
    }
    Ok(())
}

/// Checks a CAM.
pub(super) fn check_cam(cam: &CAM) -> Checked {
    let Some(containers) = &cam.cam.cam_parameters.extension_containers else {
        return Ok(());
    };
    let is_empty = |data: &[u8]| data.is_empty();
    if containers
        .0
        .iter()
        .any(|one| is_empty(&one.container_data.0))
    {
        return Err(BrokenRule::NoOctets {
            field: "extensionContainers",
        });
    }
    Ok(())
}

/// Checks a VAM on the dictionary v2.1.1.
pub(super) fn check_vam211(vam: &VAM211) -> Checked {
    match &vam.vam.vam_parameters.vru_cluster_information_container {
        Some(cluster) => check_cluster(&cluster.vru_cluster_information),
        None => Ok(()),
    }
}

/// Checks a VAM.
pub(super) fn check_vam(vam: &VAM) -> Checked {
    let parameters = &vam.vam.vam_parameters;
    if let Some(lane) = &parameters.vru_high_frequency_container.vru_lane_position {
        let information = &lane.confidence;
        bits(
            "usedDetectionInformation",
            &information.used_detection_information.0,
            16,
        )?;
        bits(
            "usedStoredInformation",
            &information.used_stored_information.0,
            8,
        )?;
    }
    if let Some(cluster) = &parameters.vru_cluster_information_container {
        check_cluster(&cluster.vru_cluster_information)?;
    }
    match &parameters.vru_motion_prediction_container {
        Some(prediction) => check_prediction(prediction),
        None => Ok(()),
    }
}

fn bits(field: &'static str, bits: &BitString, size: usize) -> Checked {
    if bits.len() != size {
        return Err(BrokenRule::BeyondRoot { field });
    }
    Ok(())
}

fn check_prediction(prediction: &VruMotionPredictionContainer) -> Checked {
    if let Some(PathHistory(points)) = &prediction.path_history {
        check_path_points(points)?;
    }
    if let Some(points) = &prediction.path_prediction {
        at_most("pathPrediction", points.0.len(), 16)?;
    }
    if let Some(distances) = &prediction.safe_distance {
        at_most("safeDistance", distances.0.len(), 8)?;
    }
    if let Some(interceptions) = &prediction.trajectory_interception_indication {
        at_most("trajectoryInterceptionIndication", interceptions.0.len(), 8)?;
    }
    Ok(())
}

fn check_path_points(points: &[PathPoint]) -> Checked {
    let times = points
        .iter()
        .filter_map(|point| point.path_delta_time.as_ref());
    for time in times {
        if !u16::try_from(&time.0).is_ok_and(|time| time > 0) {
            return Err(BrokenRule::BeyondRoot {
                field: "pathDeltaTime",
            });
        }
    }
    Ok(())
}

fn check_cluster(cluster: &VruClusterInformation) -> Checked {
    match &cluster.cluster_bounding_box_shape {
        None | Some(Shape::rectangular(_) | Shape::circular(_)) => Ok(()),
        Some(Shape::polygonal(shape)) if shape.polygon.len() < 3 => {
            Err(BrokenRule::BeyondRoot { field: "polygon" })
        }
        Some(Shape::polygonal(shape)) => at_most("polygon", shape.polygon.len(), 16),
        Some(_) => Err(BrokenRule::ClusterShape),
    }
}
