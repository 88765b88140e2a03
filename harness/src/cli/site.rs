//! `crossguard site`.

use std::path::{Path, PathBuf};

use clap::Subcommand;
use crossguard_robot::plan_file::PlanFile;
use crossguard_robot::site_file::SiteFile;

use super::{Failure, print};

#[derive(Subcommand)]
pub(super) enum Command {
    /// Tell whether a site and a plan fit: places, lanes, tasks, and bodies kept apart.
    Check(Files),
}

/// Files to check.
#[derive(clap::Args)]
pub(super) struct Files {
    /// The site; by default the street of the demonstrations.
    #[arg(long, value_name = "FILE")]
    site: Option<PathBuf>,
    /// The plan: a file, or the name of one that comes with the kit.
    #[arg(long, value_name = "FILE|NAME")]
    plan: Option<PathBuf>,
}

pub(super) fn run(command: &Command) -> Result<(), Failure> {
    let Command::Check(files) = command;
    let site = or_street(files.site.as_deref())?;
    print(said(&site, files.plan.as_deref()).map_err(Failure::Input)?)
}

/// Verdict on a site that fits, alone or with a plan; the error says why it does not.
pub(super) fn said(site: &SiteFile, plan: Option<&Path>) -> Result<String, String> {
    let (name, lanes, places) = (&site.name, site.lanes.len(), site.places.len());
    let site_said = format!("site {name}: {lanes} lanes, {places} places");
    let Some(plan) = plan else {
        return Ok(site_said);
    };
    let plan = PlanFile::open(plan, site.clone()).map_err(|cause| cause.to_string())?;
    let (name, roles, stages) = (&plan.name, plan.roles.len(), plan.stages.len());
    Ok(format!(
        "{site_said}\nplan {name}: {roles} roles, {stages} stages; it fits"
    ))
}

/// The site in a file; without one the street of the demonstrations.
pub(super) fn or_street(file: Option<&Path>) -> Result<SiteFile, Failure> {
    let read = |file| SiteFile::read(file).map_err(Failure::input);
    file.map_or_else(|| Ok(SiteFile::street()), read)
}

/// The site that an option names, if it names one: a file, or the street of the demonstrations.
pub(super) fn named(path: Option<&Path>) -> Result<Option<SiteFile>, Failure> {
    path.map(|path| match path.to_str() {
        Some("street") => Ok(SiteFile::street()),
        _ => SiteFile::read(path).map_err(Failure::input),
    })
    .transpose()
}
