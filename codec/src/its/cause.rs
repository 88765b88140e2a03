//! What the causes of events are called (TS 102 894-2 v2.4.1, `CauseCodeV2` and its sub causes).

use std::fmt;

use serde::Serialize;

use crate::asn1::cam::CauseCodeV2;

/// What an event is: the numbers, and what the dictionary calls them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Cause {
    /// The cause; those from 129 on are of release 1 and have no name.
    pub code: u8,
    /// Its name, if the dictionary has assigned one.
    pub name: Option<&'static str>,
    /// The sub cause, whose meaning depends on the cause; 0 is none.
    pub sub_code: u8,
    /// Its name, if the dictionary has assigned one.
    pub sub_name: Option<&'static str>,
}

impl From<&CauseCodeV2> for Cause {
    fn from(pair: &CauseCodeV2) -> Self {
        let (code, sub_code) = (pair.cause_code, pair.sub_cause_code);
        let names = names(code);
        Self {
            code,
            name: names.map(|(cause, _)| cause),
            sub_code,
            sub_name: names
                .and_then(|(_, sub_causes)| sub_causes.get(usize::from(sub_code)))
                .copied(),
        }
    }
}

/// `collisionRisk (vulnerableRoadUser)`, and numbers for what has no name.
impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name {
            Some(name) => f.write_str(name)?,
            None => write!(f, "cause {}", self.code)?,
        }
        match (self.sub_code, self.sub_name) {
            (0, _) => Ok(()),
            (_, Some(name)) => write!(f, " ({name})"),
            (number, None) => write!(f, " ({number})"),
        }
    }
}

/// The name of a cause, and those of its sub causes from 0 on.
type Names = (&'static str, &'static [&'static str]);

const fn names(cause: u8) -> Option<Names> {
    Some(match cause {
        1 => ("trafficCondition", TRAFFIC_CONDITION),
        2 => ("accident", ACCIDENT),
        3 => ("roadworks", ROADWORKS),
        4 => ("detectedRoadworks", &[]),
        5 => ("impassability", IMPASSABILITY),
        6 => ("adhesion", ADHESION),
        7 => ("aquaplaning", &[]),
        9 => ("hazardousLocation-SurfaceCondition", SURFACE),
        10 => ("hazardousLocation-ObstacleOnTheRoad", OBSTACLE),
        11 => ("hazardousLocation-AnimalOnTheRoad", ANIMAL),
        12 => ("humanPresenceOnTheRoad", HUMAN_PRESENCE),
        14 => ("wrongWayDriving", WRONG_WAY),
        15 => ("rescueRecoveryAndMaintenanceWorkInProgress", RESCUE),
        17 => ("adverseWeatherCondition-Wind", WIND),
        18 => ("adverseWeatherCondition-Visibility", VISIBILITY),
        19 => ("adverseWeatherCondition-Precipitation", PRECIPITATION),
        20 => ("violence", &[]),
        26 => ("slowVehicle", SLOW_VEHICLE),
        27 => ("dangerousEndOfQueue", END_OF_QUEUE),
        28 => ("publicTransportVehicleApproaching", &[]),
        42 => ("dontPanic", &[]),
        91 => ("vehicleBreakdown", BREAKDOWN),
        92 => ("postCrash", POST_CRASH),
        93 => ("humanProblem", HUMAN_PROBLEM),
        94 => ("stationaryVehicle", STATIONARY_VEHICLE),
        95 => ("emergencyVehicleApproaching", EMERGENCY_VEHICLE),
        96 => ("hazardousLocation-DangerousCurve", CURVE),
        97 => ("collisionRisk", COLLISION_RISK),
        98 => ("signalViolation", SIGNAL_VIOLATION),
        99 => ("dangerousSituation", DANGEROUS_SITUATION),
        100 => ("railwayLevelCrossing", LEVEL_CROSSING),
        _ => return None,
    })
}

const TRAFFIC_CONDITION: &[&str] = &[
    "unavailable",
    "increasedVolumeOfTraffic",
    "trafficJamSlowlyIncreasing",
    "trafficJamIncreasing",
    "trafficJamStronglyIncreasing",
    "trafficJam",
    "trafficJamSlightlyDecreasing",
    "trafficJamDecreasing",
    "trafficJamStronglyDecreasing",
    "trafficJamStable",
];

const ACCIDENT: &[&str] = &[
    "unavailable",
    "multiVehicleAccident",
    "heavyAccident",
    "accidentInvolvingLorry",
    "accidentInvolvingBus",
    "accidentInvolvingHazardousMaterials",
    "accidentOnOppositeLane-deprecated",
    "unsecuredAccident",
    "assistanceRequested",
];

const ROADWORKS: &[&str] = &[
    "unavailable",
    "roadOrCarriagewayClosure",
    "roadMarkingWork-deprecated",
    "movingLaneClosure",
    "stationaryLaneClosure",
    "streetCleaning-deprecated",
    "winterService-deprecated",
    "setupPhase",
    "remodellingPhase",
    "dismantlingPhase",
    "carriagewayCrossover",
];

const IMPASSABILITY: &[&str] = &[
    "unavailable",
    "flooding",
    "dangerOfAvalanches",
    "blastingOfAvalanches",
    "landslips",
    "chemicalSpillage",
    "winterClosure",
    "sinkhole",
    "earthquakeDamage",
    "fallenTrees",
    "rockfalls",
    "sewerOverflow",
    "stormDamage",
    "subsidence",
    "burstPipe",
    "burstWaterMain",
    "fallenPowerCables",
    "snowDrifts",
];

const ADHESION: &[&str] = &[
    "unavailable",
    "heavyFrostOnRoad",
    "fuelOnRoad",
    "mudOnRoad",
    "snowOnRoad",
    "iceOnRoad",
    "blackIceOnRoad",
    "oilOnRoad",
    "looseChippings",
    "instantBlackIce",
    "roadsSalted",
    "flooding",
    "waterOnRoad",
];

const SURFACE: &[&str] = &[
    "unavailable",
    "rockfalls",
    "earthquakeDamage-deprecated",
    "sinkhole",
    "subsidence",
    "snowDrifts-deprecated",
    "stormDamage-deprecated",
    "burstPipe-deprecated",
    "lava",
    "fallingIce-deprecated",
    "fire",
    "flooding-deprecated",
    "wearAndTear",
];

const OBSTACLE: &[&str] = &[
    "unavailable",
    "shedLoad",
    "partsOfVehicles",
    "partsOfTyres",
    "bigObjects",
    "fallenTrees",
    "hubCaps",
    "waitingVehicles-deprecated",
];

const ANIMAL: &[&str] = &[
    "unavailable",
    "wildAnimals",
    "herdOfAnimals",
    "smallAnimals",
    "largeAnimals",
    "wildAnimalsSmall",
    "wildAnimalsLarge",
    "domesticAnimals",
    "domesticAnimalsSmall",
    "domesticAnimalsLarge",
];

const HUMAN_PRESENCE: &[&str] = &[
    "unavailable",
    "childrenOnRoadway",
    "cyclistOnRoadway",
    "motorcyclistOnRoadway",
    "pedestrian",
    "ordinary-pedestrian",
    "road-worker",
    "first-responder",
    "lightVruVehicle",
    "bicyclist",
    "wheelchair-user",
    "horse-and-rider",
    "rollerskater",
    "e-scooter",
    "personal-transporter",
    "pedelec",
    "speed-pedelec",
    "ptw",
    "moped",
    "motorcycle",
    "motorcycle-and-sidecar-right",
    "motorcycle-and-sidecar-left",
];

const WRONG_WAY: &[&str] = &["unavailable", "wrongLane-deprecated", "wrongDirection"];

const RESCUE: &[&str] = &[
    "unavailable",
    "emergencyVehicles",
    "rescueHelicopterLanding",
    "policeActivityOngoing",
    "medicalEmergencyOngoing",
    "childAbductionInProgress-deprecated",
    "prioritizedVehicle",
    "rescueAndRecoveryVehicle",
];

const WIND: &[&str] = &[
    "unavailable",
    "strongWinds",
    "damagingHail-deprecated",
    "hurricane",
    "thunderstorm",
    "tornado",
    "blizzard",
];

const VISIBILITY: &[&str] = &[
    "unavailable",
    "fog",
    "smoke",
    "snowfall",
    "rain",
    "hail",
    "lowSunGlare",
    "sandstorms",
    "swarmsOfInsects",
];

const PRECIPITATION: &[&str] = &["unavailable", "rain", "snowfall", "hail"];

const SLOW_VEHICLE: &[&str] = &[
    "unavailable",
    "maintenanceVehicle",
    "vehiclesSlowingToLookAtAccident",
    "abnormalLoad",
    "abnormalWideLoad",
    "convoy",
    "winterMaintenanceSnowplough",
    "deicing-deprecated",
    "winterMaintenanceAdhesionImprovement",
];

const END_OF_QUEUE: &[&str] = &[
    "unavailable",
    "suddenEndOfQueue",
    "queueOverHill",
    "queueAroundBend",
    "queueInTunnel",
];

const BREAKDOWN: &[&str] = &[
    "unavailable",
    "lackOfFuel",
    "lackOfBatteryPower",
    "engineProblem",
    "transmissionProblem",
    "engineCoolingProblem",
    "brakingSystemProblem",
    "steeringProblem",
    "tyrePuncture-deprecated",
    "tyrePressureProblem",
    "vehicleOnFire",
];

const POST_CRASH: &[&str] = &[
    "unavailable",
    "accidentWithoutECallTriggered",
    "accidentWithECallManuallyTriggered",
    "accidentWithECallAutomaticallyTriggered",
    "accidentWithECallTriggeredWithoutAccessToCellularNetwork",
];

const HUMAN_PROBLEM: &[&str] = &[
    "unavailable",
    "glycemiaProblem",
    "heartProblem",
    "unresponsiveDriver",
];

const STATIONARY_VEHICLE: &[&str] = &[
    "unavailable",
    "humanProblem-deprecated",
    "vehicleBreakdown",
    "postCrash",
    "publicTransportStop",
    "carryingDangerousGoods",
    "vehicleOnFire",
];

const EMERGENCY_VEHICLE: &[&str] = &[
    "unavailable",
    "emergencyVehicleApproaching",
    "prioritizedVehicleApproaching",
];

const CURVE: &[&str] = &[
    "unavailable",
    "dangerousLeftTurnCurve",
    "dangerousRightTurnCurve",
    "multipleCurvesStartingWithUnknownTurningDirection",
    "multipleCurvesStartingWithLeftTurn",
    "multipleCurvesStartingWithRightTurn",
];

const COLLISION_RISK: &[&str] = &[
    "unavailable",
    "longitudinalCollisionRisk",
    "crossingCollisionRisk",
    "lateralCollisionRisk",
    "vulnerableRoadUser",
    "collisionRiskWithPedestrian",
    "collisionRiskWithCyclist",
    "collisionRiskWithMotorVehicle",
    "erraticDriving",
    "recklessDriving",
];

const SIGNAL_VIOLATION: &[&str] = &[
    "unavailable",
    "stopSignViolation",
    "trafficLightViolation",
    "turningRegulationViolation",
];

const DANGEROUS_SITUATION: &[&str] = &[
    "unavailable",
    "emergencyElectronicBrakeEngaged",
    "preCrashSystemEngaged",
    "espEngaged",
    "absEngaged",
    "aebEngaged",
    "brakeWarningEngaged",
    "collisionRiskWarningEngaged",
    "riskMitigationFunctionEngaged",
];

const LEVEL_CROSSING: &[&str] = &[
    "unavailable",
    "doNotCrossAbnormalSituation",
    "closed",
    "unguarded",
    "nominal",
    "trainApproaching",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_is_called_what_the_dictionary_calls_it() {
        let text = |cause, sub_cause| Cause::from(&CauseCodeV2::new(cause, sub_cause)).to_string();
        assert_eq!(text(97, 4), "collisionRisk (vulnerableRoadUser)");
        assert_eq!(text(97, 0), "collisionRisk");
        assert_eq!(text(97, 200), "collisionRisk (200)");
        assert_eq!(text(7, 1), "aquaplaning (1)");
        assert_eq!(text(0, 0), "cause 0");
        assert_eq!(text(128, 3), "cause 128 (3)");
        let person = Cause::from(&CauseCodeV2::new(12, 0));
        assert_eq!(person.sub_name, Some("unavailable"));
    }

    #[test]
    fn every_list_of_sub_causes_begins_with_unavailable_and_names_none_twice() {
        let all: Vec<Names> = (0..=u8::MAX).filter_map(names).collect();
        assert_eq!(all.len(), 31);
        for (cause, sub_causes) in &all {
            assert_eq!(all.iter().filter(|(other, _)| other == cause).count(), 1);
            assert!(matches!(sub_causes.first(), None | Some(&"unavailable")));
            let different: std::collections::BTreeSet<_> = sub_causes.iter().collect();
            assert_eq!(different.len(), sub_causes.len(), "{cause}");
        }
    }
}
