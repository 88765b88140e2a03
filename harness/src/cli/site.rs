//! `crossguard site`.

use std::path::{Path, PathBuf};

use clap::Subcommand;
use crossguard_harness::site_picture;
use crossguard_robot::plan_file::PlanFile;
use crossguard_robot::site_file::SiteFile;

use super::{Failure, print};

#[derive(Subcommand)]
pub(super) enum Command {
    /// Tell whether a site and a plan fit: places, lanes, tasks, and bodies kept apart.
    Check(Files),
    /// Draw a site and a plan to scale, as a picture or a text.
    Draw(Drawing),
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

#[derive(clap::Args)]
pub(super) struct Drawing {
    #[command(flatten)]
    files: Files,
    /// Write the picture to this file; without it, a text is printed.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
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
        Command::Draw(drawing) => {
            let (site, plan) = drawing.files.open()?;
            let Some(path) = &drawing.svg else {
                return print(site_picture::text(&site, plan.as_ref()).trim_end());
            };
            let picture = site_picture::svg(&site, plan.as_ref());
            std::fs::write(path, picture)
                .map_err(|error| Failure::Input(format!("{}: {error}", path.display())))
        }
    }
}

/// The site that an option names, if it names one: a file, or the street of the demonstrations.
pub(super) fn named(path: Option<&Path>) -> Result<Option<SiteFile>, Failure> {
    path.map(|path| match path.to_str() {
        Some("street") => Ok(SiteFile::street()),
        _ => SiteFile::read(path).map_err(Failure::input),
    })
    .transpose()
}
