//! `crossguard site`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Subcommand;
use crossguard_robot::plan::Who;
use crossguard_robot::plan_file::PlanFile;
use crossguard_robot::site::Place;
use crossguard_robot::site_file::{Purpose, SiteFile};

use super::{Failure, print};

#[derive(Subcommand)]
pub(super) enum Command {
    /// Tell whether a site and a plan fit: places, lanes, tasks, and bodies kept apart.
    Check(Files),
    /// Print the places of a site, and the way of each role of a plan from place to place.
    Draw(Files),
}

/// What is looked at.
#[derive(clap::Args)]
pub(super) struct Files {
    /// The site; by default the street of the demonstrations.
    #[arg(long, value_name = "FILE")]
    site: Option<PathBuf>,
    /// The plan: a file, or the name of one that comes with the kit.
    #[arg(long, value_name = "FILE|NAME")]
    plan: Option<PathBuf>,
}

impl Files {
    fn open(&self) -> Result<(SiteFile, Option<PlanFile>), Failure> {
        let site = match &self.site {
            Some(path) => SiteFile::read(path).map_err(Failure::input)?,
            None => SiteFile::street(),
        };
        let plan = self.plan.as_deref();
        let plan = plan.map(|name| PlanFile::open(name, site.clone()));
        Ok((site, plan.transpose().map_err(Failure::input)?))
    }
}

pub(super) fn run(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Check(files) => {
            let (site, plan) = files.open()?;
            let (lanes, places) = (site.lanes.len(), site.places.len());
            print(format_args!(
                "site {}: {lanes} lanes, {places} places",
                site.name
            ))?;
            plan.map_or(Ok(()), |plan| {
                let (roles, stages) = (plan.roles.len(), plan.stages.len());
                print(format_args!(
                    "plan {}: {roles} roles, {stages} stages; it fits",
                    plan.name
                ))
            })
        }
        Command::Draw(files) => {
            let (site, plan) = files.open()?;
            print(text(&site, plan.as_ref()).trim_end())
        }
    }
}

/// A site, and the ways of the roles through it: where each is before, and the targets of its stages, with their tasks.
fn text(site: &SiteFile, plan: Option<&PlanFile>) -> String {
    let mut out = format!(
        "site {} at {:.6}, {:.6}\n",
        site.name, site.site.latitude, site.site.longitude
    );
    for lane in &site.lanes {
        let bearing = lane.from.bearing(lane.to);
        let (name, width) = (&lane.name, lane.width_m);
        let _ = writeln!(
            out,
            "  lane {name}: {width} m wide, traffic towards {bearing:.0} degrees"
        );
    }
    for (name, spot) in &site.places {
        let purpose = match spot.purpose {
            Purpose::Wait => "wait",
            Purpose::Guard => "guard",
            Purpose::Cross => "cross",
        };
        line(&mut out, name, spot.place, purpose);
    }
    let Some(plan) = plan else { return out };
    let _ = writeln!(out, "plan {}: {}", plan.name, plan.summary);
    let (leaders, followers): (Vec<_>, Vec<_>) = plan.roles.iter().partition(|role| role.leads);
    for role in leaders {
        for (place, what) in [(role.waits, "waits"), (role.stands, "leads")] {
            if let Some(place) = place {
                line(&mut out, &role.name, place, what);
            }
        }
    }
    for (seat, role) in followers.into_iter().enumerate() {
        if let Some(place) = role.waits {
            line(&mut out, &role.name, place, "waits");
        }
        for (number, stage) in (1..).zip(&plan.stages) {
            let mut parts = stage.parts.iter();
            if let Some((_, leg)) = parts.find(|(who, _)| *who == Who::Role(seat)) {
                line(
                    &mut out,
                    &role.name,
                    leg.to,
                    &format!("{number} {}", leg.task),
                );
            }
        }
    }
    out
}

fn line(out: &mut String, name: &str, Place { east, north }: Place, what: &str) {
    let _ = writeln!(out, "  {name:<20} {east:>7.2} {north:>7.2}  {what}");
}

/// The site that an option names, if it names one: a file, or the street of the demonstrations.
pub(super) fn named(path: Option<&Path>) -> Result<Option<SiteFile>, Failure> {
    path.map(|path| match path.to_str() {
        Some("street") => Ok(SiteFile::street()),
        _ => SiteFile::read(path).map_err(Failure::input),
    })
    .transpose()
}
