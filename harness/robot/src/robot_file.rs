//! The configuration of one robot: a TOML file for `crossguard run`.

mod body;
mod link;
mod traits;
mod zone;

use std::net::SocketAddr;
use std::path::{Path, PathBuf};

use crossguard_codec::{IdentifierClash, Identifiers, JobRole, NoMapPlace, SignalMeans};
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering;
use crossguard_endpoint::ras::surroundings::{Awareness, CLUSTER_INTERVAL_MS};
use crossguard_endpoint::station::Security;
use crossguard_protocol::{
    BrokenInequality, Config, Settings, SettingsInFiles, StationId, TaskType,
};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::application::{Application, Traits};
use crate::body::{Body, BodyPort, Build, Ported, Simulated};
use crate::boot::Boot;
use crate::files;
use crate::journal::Journal;
use crate::located::{Exact, FileError, Impossible, NEAR_M, Number, cut, is_near, possible};
use crate::operator::means;
use crate::plan::Plan;
use crate::plan_file::PlanFile;
use crate::port::{NoAddress, PortAddress};
use crate::runtime::Setup;
use crate::site::{NoCrossing, NoOrigin, Place, Site, crossing_named};
use crate::site_file::SiteFile;
use crate::street::{Road, Street};
use crate::transport::{Halves, Link};
use crate::zone::Zone;

use self::body::BodyTable;
pub use self::body::NoBody;
use self::link::LinkTable;
use self::traits::BatteryTable;
pub use self::traits::{NoTraits, job_named};
pub use self::zone::NoZone;
use self::zone::{ZoneTable, check_escort, outline};

/// A robot's configuration, checked.
#[derive(Clone, Debug)]
pub struct RobotFile {
    /// Its name.
    pub name: String,
    /// Its station id.
    pub station: StationId,
    /// Its build.
    pub build: Build,
    /// Its further traits.
    pub traits: Traits,
    /// Where its boot counter is kept.
    pub boot_file: PathBuf,
    /// Where it waits, off the carriageway, if that is said; a simulated body begins there, or else at the origin.
    pub place: Option<Place>,
    /// Where the origin of places is.
    pub site: Site,
    /// How many times as fast as real its simulated body moves.
    pub speed: f64,
    /// Whether it leads the crossing by itself once a pedestrian is detected. Without a zone, the pedestrian is
    /// simulated then.
    pub autopilot: bool,
    /// By what it shows signals to people, if it can.
    pub shows: Option<SignalMeans>,
    /// Where its sensors have everybody who waits to cross or crosses, if they do.
    pub zone: Option<Zone>,
    /// The carriageway of its site, where that has a crossing.
    pub carriageway: Option<Area>,
    /// The kerbs between which it has people escorted, where they are not those of its plan.
    pub kerbs: Option<[Place; 2]>,
    /// Its plan for leading by itself, if a file has one; otherwise the paper's crossing.
    pub plan_file: Option<PlanFile>,
    /// Where its body connects, if that is another process.
    pub body_port: Option<BodyPort>,
    /// Where other programs command and watch it, if they may.
    pub operator_port: Option<PortAddress>,
    /// Its link.
    pub link: Link,
    /// The protocol's configuration.
    pub config: Config,
    /// Identifiers that no standard has assigned.
    pub identifiers: Identifiers,
    /// How it announces the people around it, and itself to stations that do not know RAM.
    pub awareness: Awareness,
    /// The file with the certificates that it does not trust any more, if there is one.
    pub revoked: Option<PathBuf>,
    /// Whether it takes what a ROS graph says, which nobody signs, where all packets have to be signed.
    pub trust_ros_graph: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "the switches of a file, each by its name"
)]
struct RobotTable {
    name: String,
    station: u32,
    build: Build,
    #[serde(default, deserialize_with = "traits::job")]
    job: Option<JobRole>,
    dimensions_m: Option<Exact<f64, 3>>,
    #[serde(default)]
    battery: BatteryTable,
    boot_file: PathBuf,
    place: Option<Exact<f64, 2>>,
    #[serde(default = "one")]
    speed: f64,
    #[serde(default)]
    autopilot: bool,
    crossing: Option<String>,
    zone: Option<ZoneTable>,
    map_place: Option<String>,
    #[serde(default, deserialize_with = "shown_by")]
    shows: Option<SignalMeans>,
    #[serde(default)]
    site: Option<SiteTable>,
    site_file: Option<PathBuf>,
    plan_file: Option<PathBuf>,
    body: Option<BodyTable>,
    operator: Option<OperatorTable>,
    link: LinkTable,
    #[serde(default, with = "SettingsInFiles")]
    protocol: Settings,
    #[serde(default)]
    identifiers: Identifiers,
    #[serde(default)]
    people: clustering::Settings,
    #[serde(default)]
    cluster_vam: bool,
    #[serde(default)]
    cam: bool,
    revoked: Option<PathBuf>,
    #[serde(default)]
    trust_ros_graph: bool,
}

/// By what a robot shows signals to people.
fn shown_by<'de, D: Deserializer<'de>>(from: D) -> Result<Option<SignalMeans>, D::Error> {
    let names = Vec::<String>::deserialize(from)?;
    let means = names.iter().map(|name| means(name));
    let all = means.reduce(|all, one| Ok(all?.union(one?)));
    all.transpose().map_err(D::Error::custom)
}

const fn one() -> f64 {
    1.0
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SiteTable {
    latitude: f64,
    longitude: f64,
}

/// Where other programs connect, to command the robot and watch it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OperatorTable {
    listen: String,
}

/// Files that are given beside a robot file, and count more.
#[derive(Clone, Copy, Default, Debug)]
pub struct Besides<'a> {
    /// The file of the site.
    pub site_file: Option<&'a Path>,
    /// The file of the plan, or the name of one that comes with the kit.
    pub plan_file: Option<&'a Path>,
}

/// Why a robot cannot be configured.
#[derive(Debug, thiserror::Error)]
#[error("{}: {cause}", path.display())]
pub struct RobotFileError {
    /// The file.
    pub path: PathBuf,
    /// The fault.
    pub cause: Impossibility,
}

impl RobotFileError {
    fn at(path: &Path, cause: impl Into<Impossibility>) -> Self {
        let (path, cause) = (path.to_owned(), cause.into());
        Self { path, cause }
    }
}

/// Fault of a configuration.
#[derive(Debug, thiserror::Error)]
pub enum Impossibility {
    /// The file cannot be read.
    #[error(transparent)]
    Unreadable(#[from] std::io::Error),
    /// The text is no configuration.
    #[error("{}", cut(&.0.to_string()))]
    Syntax(#[from] Box<toml::de::Error>),
    /// Timers contradict each other.
    #[error("[protocol] {0}")]
    Settings(#[from] BrokenInequality),
    /// `t_cross` is shorter than a slow walker takes.
    #[error(
        "[protocol] t_cross is {t_cross_s} s: a slow walker (0.9 m/s) is on the carriageway for {walk_s:.1} s"
    )]
    CrossingTime {
        /// `t_cross`, in seconds.
        t_cross_s: f64,
        /// How long a slow walker is on the carriageway, in seconds.
        walk_s: f64,
    },
    /// An escort would be sent ahead of its person.
    #[error(
        "[protocol] holding has 'move': an escort guards beside a person on the way, and not from a place over there"
    )]
    EscortHolds,
    /// Identifiers contradict each other.
    #[error("[identifiers] {0}")]
    Identifiers(#[from] IdentifierClash),
    /// There is no link, or there are two.
    #[error(
        "[link] wants either 'address' and 'peers', or 'multicast' and 'interface', each with a 'framing' or \
         without, or 'unit' with or without 'sends' and an 'address', or 'ethernet'"
    )]
    Link,
    /// No datagram can be sent there.
    #[error(
        "[link] nothing can be sent to {0}: peers and units have an address of their own and a port"
    )]
    Peer(SocketAddr),
    /// The body's time does not pass, or goes back.
    #[error(transparent)]
    Speed(#[from] Impossible),
    /// The name is blank, so it tells the robot from no other.
    #[error("name: a name with at least one character other than white space is wanted")]
    Name,
    /// No station has this id.
    #[error("station is 0: a number from 1 to 4294967295 is wanted, which no other robot has")]
    Station,
    /// A peer is the robot itself.
    #[error(
        "[link] {0} is the robot's own address: 'peers' and 'unit' are the addresses of others"
    )]
    OwnAddress(SocketAddr),
    /// A robot that leads by itself does not know where robots go on a site of its own.
    #[error(
        "'autopilot' on a site of its own wants 'plan_file': \"crossing\" is the paper's crossing, at the places of the site"
    )]
    NoPlan,
    /// No place of a site.
    #[error(
        "place is [{}, {}]: metres east and north of the site's origin are wanted, each from -{NEAR_M} to {NEAR_M}",
        Number(&.0.east), Number(&.0.north)
    )]
    Place(Place),
    /// A robot would wait among vehicles.
    #[error(
        "place is [{}, {}], on the carriageway: a place beside it is wanted, where the robot waits",
        Number(&.0.east), Number(&.0.north)
    )]
    OnRoad(Place),
    /// People cannot be clustered so.
    #[error("[people] {0}")]
    People(&'static str),
    /// The crossing has no such name.
    #[error("crossing: {0}")]
    Crossing(#[from] NoCrossing),
    /// No robot is like that.
    #[error(transparent)]
    Traits(#[from] NoTraits),
    /// No body can be reached like that.
    #[error("[body] {0}")]
    Body(#[from] NoBody),
    /// No program can connect there.
    #[error("[operator] {0}")]
    Operator(NoAddress),
    /// There is no such zone.
    #[error("[zone] {0}")]
    Zone(#[from] NoZone),
    /// No place of a map.
    #[error("map_place: {0}")]
    MapPlace(#[from] NoMapPlace),
    /// The site is said twice.
    #[error("[site] and 'site_file' both say where the site is: one of them is wanted")]
    TwoSites,
    /// A file of the site or the plan does not fit.
    #[error(transparent)]
    File(#[from] FileError),
    /// A site that is not on earth.
    #[error("[site] {0}")]
    Site(#[from] NoOrigin),
}

impl RobotFile {
    /// Reads a configuration. Paths in it are relative to its folder.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn read(path: &Path) -> Result<Self, RobotFileError> {
        Self::read_with(path, Besides::default())
    }

    /// The same, with another site or plan than the file names.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn read_with(path: &Path, besides: Besides<'_>) -> Result<Self, RobotFileError> {
        let text = files::text(path, files::TEXT_MAX);
        let text = text.map_err(|cause| RobotFileError::at(path, cause))?;
        Self::parse(path, &text, besides)
    }

    /// The same, from the text of the file.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn parse(path: &Path, text: &str, besides: Besides<'_>) -> Result<Self, RobotFileError> {
        let file = toml::from_str::<RobotTable>(text).map_err(Box::new);
        let mut file = file.map_err(|cause| RobotFileError::at(path, cause))?;
        let folder = path.parent().unwrap_or(Path::new("."));
        file.name_files(folder, besides);
        let checked = file.check(folder);
        checked.map_err(|cause| RobotFileError::at(path, cause))
    }

    /// A simulated body at its place; `seed` is that of its gait.
    #[must_use]
    pub fn body(&self, seed: u64) -> Simulated {
        Simulated::new(
            self.build,
            self.site,
            self.place.unwrap_or_default(),
            self.speed,
            seed,
        )
        .holding(self.config.settings().holding)
    }

    /// Its body: another process where the file says so, and simulated otherwise, with this seed of its gait.
    ///
    /// # Errors
    /// When the port of the body cannot be opened.
    pub fn body_or_port(&self, seed: u64) -> std::io::Result<Box<dyn Body>> {
        let Some(port) = self.body_port.clone() else {
            return Ok(Box::new(self.body(seed)));
        };
        let holding = self.config.settings().holding;
        let place = self.place.unwrap_or_default();
        let body = Ported::open(&self.name, self.build, self.site, place, port, holding)?;
        Ok(Box::new(body))
    }

    /// Its knowledge of the people on the road: from its sensors, from its simulation, or else from what others tell
    /// of the carriageway of its site.
    #[must_use]
    pub fn road(&self) -> Road {
        match &self.zone {
            Some(zone) => Road::Watched(zone.clone()),
            None if self.autopilot => Road::Own(self.street()),
            None => (self.carriageway.clone()).map_or(Road::Unknown, Road::Heard),
        }
    }

    /// A simulated street, which people cross where it has them escorted.
    fn street(&self) -> Street {
        let kerbs = self.plan().and_then(|plan| plan.kerbs);
        kerbs.map_or_else(Street::default, |[from, to]| Street::between(from, to))
    }

    /// Its plan, if it leads by itself.
    #[must_use]
    pub fn plan(&self) -> Option<Plan> {
        self.autopilot.then(|| match (self.kerbs, &self.plan_file) {
            (kerbs, None) => own_plan(self.site, kerbs),
            (_, Some(file)) => file.plan(self.station, file.followers),
        })
    }

    /// The robot with this boot counter and body, on a clock that begins now.
    #[must_use]
    pub fn setup(
        &self,
        boot: Boot,
        body: Box<dyn Body>,
        security: Security,
        link: Halves,
        journal: Journal,
    ) -> Setup {
        let application = Application::new(body, self.plan())
            .at(self.site)
            .on(self.road())
            .with_traits(self.traits)
            .showing_by(self.shows);
        let application = match self.place {
            Some(place) => application.with_home(place),
            None => application,
        };
        Setup {
            boot,
            config: self.config.clone(),
            identifiers: self.identifiers,
            security,
            awareness: self.awareness,
            journal,
            ..Setup::new(&self.name, self.station, application, link)
        }
    }
}

/// The plan of a robot that leads without a file of it: between these kerbs, or those of the paper's crossing.
fn own_plan(site: Site, kerbs: Option<[Place; 2]>) -> Plan {
    match kerbs {
        Some([from, to]) => Plan::escort(site, from, to),
        None => Plan::crossing(site),
    }
}

impl RobotTable {
    /// Finds the files that it names: beside it, or where the command says.
    fn name_files(&mut self, folder: &Path, besides: Besides<'_>) {
        let beside = |path: PathBuf| folder.join(path);
        // A name of a shipped plan is no path.
        let plan = |path: PathBuf| match path.extension() {
            Some(_) => beside(path),
            None => path,
        };
        let site_file = besides.site_file.map(Path::to_owned);
        if site_file.is_some() {
            self.site = None;
        }
        self.site_file = site_file.or(self.site_file.take().map(beside));
        let plan_file = besides.plan_file.map(Path::to_owned);
        self.plan_file = plan_file.or(self.plan_file.take().map(plan));
    }

    /// The site: that of its file, or the street of the demonstrations where the table says.
    fn site(&self) -> Result<SiteFile, Impossibility> {
        match (&self.site, &self.site_file) {
            // A robot whose site nobody says serves no place of a map.
            (None, None) => Ok(SiteFile::street().at(Site::default())),
            (None, Some(path)) => Ok(SiteFile::read(path)?),
            (Some(_), Some(_)) => Err(Impossibility::TwoSites),
            (Some(table), None) => {
                let site = Site::at(table.latitude, table.longitude)?;
                Ok(SiteFile::street().at(site))
            }
        }
    }

    fn check(self, folder: &Path) -> Result<RobotFile, Impossibility> {
        let from_1_to_100 = "a number from 1 to 100";
        let speed = possible("speed", self.speed, 1.0..=100.0, from_1_to_100)?;
        if self.name.trim().is_empty() {
            return Err(Impossibility::Name);
        }
        if self.station == 0 {
            return Err(Impossibility::Station);
        }
        let place = self
            .place
            .map(|Exact([east, north])| Place::new(east, north));
        if let Some(far) = place.filter(|it| !is_near([it.east, it.north])) {
            return Err(Impossibility::Place(far));
        }
        let layout = self.site()?;
        let crossing = self.crossing.as_deref().map(crossing_named);
        let (reference, intersection) = crossing.transpose()?.unzip();
        let map_place = self.map_place.as_deref().map(str::parse).transpose()?;
        let site = Site {
            crossing: reference.unwrap_or(layout.site.crossing),
            // A file that says nothing else commands maneuvers at the crossing.
            map_place: map_place.or(intersection).or(layout.site.map_place),
            ..layout.site
        };
        self.identifiers.check()?;
        self.people.check().map_err(Impossibility::People)?;
        // A plan is for a robot that leads by itself.
        let autopilot = self.autopilot || self.plan_file.is_some();
        let confidence_min = self.people.confidence_min;
        let zone = self
            .zone
            .map(|zone| zone.check(&layout, confidence_min, autopilot));
        let (zone, kerbs) = zone.transpose()?.unzip();
        check_people(self.body.as_ref(), autopilot, zone.is_some())?;
        let config = Config::new(self.protocol)?;
        if config.settings().holding.contains(TaskType::MOVE) {
            return Err(Impossibility::EscortHolds);
        }
        let t_cross_s = f64::from(config.settings().t_cross.0) / 1_000.0;
        // A file without a site has the street of the demonstrations, which says nothing of a road of its own.
        let unsited = zone.as_ref().filter(|_| self.site_file.is_none());
        let walk_s = unsited.and_then(Zone::walk_s).or_else(|| layout.walk_s());
        if let Some(walk_s) = walk_s.filter(|walk_s| *walk_s > t_cross_s) {
            return Err(Impossibility::CrossingTime { t_cross_s, walk_s });
        }
        let area = |corners| Area::Polygon(outline(corners));
        let carriageway = layout.carriageway();
        let carriageway = carriageway.map(|it| (area(it.whole), area(it.crossing)));
        let (carriageway, crossing) = carriageway.unzip();
        let own_road = zone.as_ref().and_then(|zone| zone.road.as_ref());
        check_road(own_road, crossing.filter(|_| self.site_file.is_some()))?;
        // A file without a site has the street of the demonstrations, unless it has a road of its own.
        let has_layout = self.site_file.is_some() || own_road.is_none();
        let is_on_road = |place: &Place| {
            let has = |road: &Area| road.contains([place.east, place.north]);
            let is_on_site =
                || carriageway.as_ref().is_some_and(has) || layout.lane_at(*place).is_some();
            own_road.is_some_and(has) || has_layout && is_on_site()
        };
        if let Some(place) = place.filter(is_on_road) {
            return Err(Impossibility::OnRoad(place));
        }
        let kerbs = kerbs.flatten();
        let is_own_site = self.site_file.is_some() || self.site.is_some() && kerbs.is_none();
        if self.autopilot && is_own_site && self.plan_file.is_none() {
            return Err(Impossibility::NoPlan);
        }
        if let (true, Some(zone), None) = (autopilot, &zone, &self.plan_file) {
            check_escort(zone, &own_plan(site, kerbs), config.settings())?;
        }
        let plan = self.plan_file.as_deref();
        let plan = plan
            .map(|name| PlanFile::open_for(name, layout.at(site), config.settings()))
            .transpose()?;
        let is_sited = self.site_file.is_some() || self.site.is_some();
        let traits = traits::check(self.job, self.dimensions_m.map(|it| it.0), &self.battery)?;
        Ok(RobotFile {
            name: self.name,
            station: StationId(self.station),
            build: self.build,
            traits,
            boot_file: folder.join(self.boot_file),
            place,
            site,
            speed,
            autopilot,
            shows: self.shows,
            zone,
            carriageway,
            kerbs,
            plan_file: plan,
            body_port: (self.body.map(|body| body.check(folder, is_sited))).transpose()?,
            operator_port: self.operator.map(|it| it.check(folder)).transpose()?,
            link: self.link.check()?,
            config,
            identifiers: self.identifiers,
            awareness: Awareness {
                clustering: self.people,
                cluster_vam_interval_ms: self.cluster_vam.then_some(CLUSTER_INTERVAL_MS),
                cam: self.cam,
            },
            revoked: self.revoked.map(|list| folder.join(list)),
            trust_ros_graph: self.trust_ros_graph,
        })
    }
}

/// A real body that leads wants sensors for people, or else the word of its file that they are simulated.
fn check_people(body: Option<&BodyTable>, leads: bool, sees: bool) -> Result<(), NoBody> {
    match body.map(|body| body.simulated_people) {
        Some(true) if sees => Err(NoBody::TwoPeoples),
        Some(false) if leads && !sees => Err(NoBody::SeesNobody),
        _ => Ok(()),
    }
}

/// A road of a zone's own has all of its site's crossing.
fn check_road(own: Option<&Area>, crossing: Option<Area>) -> Result<(), NoZone> {
    let (Some(road), Some(crossing)) = (own, crossing.map(Zone::of_road)) else {
        return Ok(());
    };
    let is_whole = crossing.covered(Some(road)) == crossing.covered(None);
    is_whole.then_some(()).ok_or(NoZone::PartialRoad)
}

impl OperatorTable {
    fn check(self, folder: &Path) -> Result<PortAddress, Impossibility> {
        PortAddress::parse(&self.listen, folder).map_err(Impossibility::Operator)
    }
}

#[cfg(test)]
mod tests;
