//! Whether a plan fits its site: every place is there and is for what the task does, and bodies are kept apart.

use std::collections::BTreeMap;

use crossguard_codec::PublicSignal;
use crossguard_crossing::STAGES_MAX;
use crossguard_protocol::{
    EndReason, MAX_FOLLOWERS, ReleaseReason, Settings, StationId, TaskNames, TaskSet, TaskType,
    Urgency,
};
use toml::Spanned;

use super::tables::{DemoTable, EndName, PartTable, PlanTables, RoleTable, SignalName, SpotName};
use super::{APART_M, Car, Ending, PlanFile, Role, safety};
use crate::located::{self, Exact, Misfit};
use crate::plan::Leg;
use crate::site::Place;
use crate::site_file::{Purpose, SiteFile};

/// For how long an unescorted pedestrian is on the road, and how long a leader has patience, in seconds.
const CROSSING_S: f64 = 8.0;
const PATIENCE_S: f64 = 200.0;

impl PlanTables {
    pub(super) fn check(
        self,
        name: &str,
        site: SiteFile,
        settings: &Settings,
    ) -> Result<PlanFile, Misfit> {
        let roles = roles(&self.roles, &site)?;
        let followers: Vec<_> = roles.iter().filter(|role| !role.leads).collect();
        let wanted = match &self.followers {
            None => followers.len(),
            Some(number) => {
                let fixed = followers.iter().filter(|role| !role.optional).count();
                // Nobody helps in a team of none.
                let least = fixed.max(1);
                let most = followers.len();
                let wanted = usize::from(*number.get_ref());
                if !(least..=most).contains(&wanted) {
                    let what = format!("{wanted} followers: {least} to {most} fit the roles");
                    return Err(Misfit::at(number, what));
                }
                wanted
            }
        };
        let stages = stages(&self, &followers, &site)?;
        apart(&self, &roles, &stages)?;
        safety::guards_first(&self, &followers, &stages, settings)?;
        safety::ways_in_time(&self, &site, &followers, &stages, settings)?;
        let either_way = self.either_way.as_ref().map(|Exact([from, to])| {
            let crossing = Some((Purpose::Cross, "an escort"));
            let kerbs = [place(&site, from, crossing)?, place(&site, to, crossing)?];
            if kerbs[0].distance(kerbs[1]) < APART_M {
                return Err(Misfit::at(
                    to,
                    "a place at each of two kerbs is wanted, and these are one",
                ));
            }
            if site.carriageway().is_some_and(|road| !road.parts(kerbs)) {
                return Err(Misfit::at(
                    to,
                    "a place at each of two kerbs is wanted, and these are on one side of the road",
                ));
            }
            safety::escorts_either_way(&self, &followers, &stages, kerbs, settings)?;
            Ok(kerbs)
        });
        let either_way = either_way.transpose()?;
        let crossing_s = located::within_if_any(self.crossing_s.as_ref(), 1.0..=600.0, "s")?;
        let crossing_s = crossing_s.unwrap_or(CROSSING_S);
        let patience_s = located::within_if_any(self.patience_s.as_ref(), 1.0..=3_600.0, "s")?;
        safety::crossing_in_time(&site, self.crossing_s.as_ref(), crossing_s, settings)?;
        let asks = self.asks_vehicles_s.as_ref();
        let asks_vehicles_s = located::within_if_any(asks, 0.0..=60.0, "s")?;
        let (loses_power, ends, car) = demo(self.demo.as_ref(), &roles, &site)?;
        Ok(PlanFile {
            name: name.to_owned(),
            summary: self.summary.unwrap_or_else(|| format!("Plan {name}.")),
            followers: u8::try_from(wanted).unwrap_or(u8::MAX),
            urgency: self.urgency.unwrap_or(Urgency::Medium),
            crossing_s,
            patience_s: patience_s.unwrap_or(PATIENCE_S),
            asks_vehicles_s: asks_vehicles_s.unwrap_or(0.0),
            either_way,
            site,
            roles,
            stages,
            loses_power,
            ends,
            car,
        })
    }
}

fn roles(tables: &[Spanned<RoleTable>], site: &SiteFile) -> Result<Vec<Role>, Misfit> {
    let mut roles: Vec<Role> = Vec::new();
    for spanned in tables {
        let table = spanned.get_ref();
        let refuse = |what: String| Err(Misfit::at(spanned, what));
        if roles.iter().any(|role| role.name == table.name) {
            return refuse(format!("there are two roles '{}'", table.name));
        }
        let has_station = |role: &Role| role.station.is_some_and(|it| Some(it.0) == table.station);
        if let Some(other) = roles.iter().find(|role| has_station(role)) {
            let (one, other) = (&table.name, &other.name);
            return refuse(format!("roles '{other}' and '{one}' are for one station"));
        }
        if table.station == Some(0) {
            return refuse(format!(
                "role '{}' is for station 0, which is no station",
                table.name
            ));
        }
        if !table.leads && table.stands.is_some() {
            let name = &table.name;
            return refuse(format!(
                "role '{name}' does not lead: where it stands is the target of its part in a stage"
            ));
        }
        if !table.leads && table.shows.is_some() {
            let name = &table.name;
            return refuse(format!(
                "role '{name}' does not lead: no command says what a follower shows"
            ));
        }
        let spot = |name: &Option<Spanned<SpotName>>| {
            let name = name.as_ref();
            name.map(|name| place(site, name, None)).transpose()
        };
        roles.push(Role {
            name: table.name.clone(),
            leads: table.leads,
            optional: table.optional,
            any: table.any,
            robot: table.robot.clone(),
            station: table.station.map(StationId),
            build: table.build,
            waits: spot(&table.waits)?,
            stands: spot(&table.stands)?,
            shows: table.shows.map(|shows| match shows {
                SignalName::Stop => PublicSignal::Stop,
                SignalName::Go => PublicSignal::Go,
                SignalName::Caution => PublicSignal::Caution,
            }),
        });
    }
    let followers = roles.iter().filter(|role| !role.leads).count();
    if followers == roles.len() {
        return Err(Misfit::whole("no role has 'leads = true'"));
    }
    if !(1..=MAX_FOLLOWERS).contains(&followers) {
        let what = format!("{followers} followers: 1 to {MAX_FOLLOWERS} are possible");
        return Err(Misfit::whole(what));
    }
    Ok(roles)
}

fn stages(
    tables: &PlanTables,
    followers: &[&Role],
    site: &SiteFile,
) -> Result<Vec<Vec<(usize, Leg)>>, Misfit> {
    if tables.stages.is_empty() {
        return Err(Misfit::whole("there is no stage"));
    }
    if let Some(further) = tables.stages.get(STAGES_MAX) {
        let what = format!("at most {STAGES_MAX} stages are possible, and this is one more");
        return Err(Misfit::at(further, what));
    }
    let mut stages = Vec::new();
    for table in &tables.stages {
        if table.get_ref().is_empty() {
            return Err(Misfit::at(table, "nobody has a part in this stage"));
        }
        let parts = table.get_ref().iter().map(|(name, part)| {
            let number = followers.iter().position(|role| role.name == *name);
            let Some(number) = number else {
                let names: Vec<_> = followers.iter().map(|role| &*role.name).collect();
                let names = names.join(", ");
                let what = format!("no follower has the role '{name}'; there are {names}");
                return Err(Misfit::at(part, what));
            };
            Ok((number, leg(part.get_ref(), site)?))
        });
        stages.push(parts.collect::<Result<_, _>>()?);
    }
    Ok(stages)
}

fn leg(part: &PartTable, site: &SiteFile) -> Result<Leg, Misfit> {
    let name = part.task.get_ref();
    let all = TaskSet(u16::MAX);
    let task = all.iter().find(|task| task.to_string() == *name);
    let Some(task) = task else {
        let what = format!("'{name}' is no task: {TaskNames} are");
        return Err(Misfit::at(&part.task, what));
    };
    let purpose = match task {
        TaskType::BLOCK => Some((Purpose::Guard, "a block")),
        TaskType::MOVE => Some((Purpose::Cross, "a move")),
        _ => None,
    };
    let mut leg = Leg::new(task, place(site, &part.to, purpose)?);
    if let Some(speed) = &part.speed_mps {
        leg.speed_mps = located::within(speed, 0.05..=5.0, "m/s")?;
    }
    let heading = part.heading_deg.as_ref();
    leg.heading_deg = located::within_if_any(heading, 0.0..=360.0, "degrees")?
        .or_else(|| site.facing_deg(leg.to));
    Ok(leg)
}

/// The place of this name, which has to be for this.
fn place(
    site: &SiteFile,
    name: &Spanned<SpotName>,
    wanted: Option<(Purpose, &str)>,
) -> Result<Place, Misfit> {
    let text = match name.get_ref() {
        SpotName::At(Exact(metres)) => {
            let place = located::place_at(name, *metres)?;
            let misfit = wanted.and_then(|(purpose, whose)| {
                site.misfit(&format!("the place of {whose}"), place, purpose)
            });
            return misfit.map_or(Ok(place), |what| Err(Misfit::at(name, what)));
        }
        SpotName::Named(text) => text,
    };
    let Some(spot) = site.places.get(text) else {
        let names: Vec<_> = site.places.keys().map(String::as_str).collect();
        let (site, names) = (&site.name, names.join(", "));
        let what = format!("site '{site}' has no place '{text}'; it has {names}");
        return Err(Misfit::at(name, what));
    };
    if let Some((purpose, whose)) = wanted
        && spot.purpose != purpose
    {
        let wanted = match purpose {
            Purpose::Wait => "wait",
            Purpose::Guard => "guard",
            Purpose::Cross => "cross",
        };
        let what = format!("place '{text}' is not for {whose}: one for = \"{wanted}\" is wanted");
        return Err(Misfit::at(name, what));
    }
    Ok(spot.place)
}

/// Looks that no two robots are sent to one place. Who has no part in a stage stays where its last one led.
fn apart(tables: &PlanTables, roles: &[Role], stages: &[Vec<(usize, Leg)>]) -> Result<(), Misfit> {
    let leaders = roles.iter().filter(|role| role.leads);
    let stand = leaders.filter_map(|role| Some((&*role.name, role.stands.or(role.waits)?)));
    let leaders: Vec<_> = stand.collect();
    let followers: Vec<_> = roles.iter().filter(|role| !role.leads).collect();
    let mut targets = BTreeMap::new();
    for (stage, table) in stages.iter().zip(&tables.stages) {
        for (number, leg) in stage {
            targets.insert(*number, leg.to);
        }
        for (own, leg) in stage {
            let (own, name) = (*own, &followers[*own].name);
            let others = targets.iter().filter(|(number, _)| **number != own);
            let others = others.map(|(number, place)| (&*followers[*number].name, *place));
            for (other, place) in others.chain(leaders.iter().copied()) {
                let metres = place.distance(leg.to);
                if metres < APART_M {
                    let what = format!(
                        "roles '{name}' and '{other}' are {metres:.2} m apart in this stage: \
                         at least {APART_M} m is wanted"
                    );
                    let part = table.get_ref().get(name);
                    return Err(Misfit::at_any(part.map(|it| &it.get_ref().to), what));
                }
            }
        }
    }
    Ok(())
}

fn demo(
    table: Option<&Spanned<DemoTable>>,
    roles: &[Role],
    site: &SiteFile,
) -> Result<(Option<String>, Ending, Option<Car>), Misfit> {
    let Some(spanned) = table else {
        return Ok((None, Ending::Session(EndReason::TaskCompleted), None));
    };
    let table = spanned.get_ref();
    if let Some(name) = &table.loses_power
        && !roles.iter().any(|role| role.robot.as_ref() == Some(name))
    {
        let what = format!("no role has the robot '{name}', which is to lose power");
        return Err(Misfit::at(spanned, what));
    }
    let ends = match table.ends {
        EndName::TaskCompleted => Ending::Session(EndReason::TaskCompleted),
        EndName::NoFollowers => Ending::Session(EndReason::NoFollowers),
        EndName::ContactLost => Ending::Released(ReleaseReason::ContactLost),
    };
    if let Some(car) = &table.car {
        let is_taken = |role: &Role| role.station == Some(StationId(car.station));
        let what = if !site.lanes.iter().any(|it| it.name == car.lane) {
            Some(format!("site '{}' has no lane '{}'", site.name, car.lane))
        } else if car.station == 0 || roles.iter().any(is_taken) {
            Some(format!(
                "station {} is no station, or that of a role",
                car.station
            ))
        } else if !(10.0..=1_000.0).contains(&car.from_m) || !(1.0..=50.0).contains(&car.speed_mps)
        {
            Some("a car comes from 10 to 1,000 m before the crossing, at 1 to 50 m/s".to_owned())
        } else {
            None
        };
        if let Some(what) = what {
            return Err(Misfit::at(spanned, what));
        }
    }
    Ok((table.loses_power.clone(), ends, table.car.clone()))
}
