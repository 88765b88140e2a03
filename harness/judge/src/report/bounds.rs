//! How long each response may take, by the settings of the robots.

use crossguard_model_check::timed::{USUAL_DELAY, bounds};
use crossguard_protocol::{Config, Settings};
use maud::{Markup, html};

use super::collect::Run;

/// A table for all robots, or one for each settings where they differ; `None` where no log says them.
pub(super) fn table(run: &Run) -> Option<Markup> {
    let mut groups: Vec<(&Settings, Vec<&str>)> = Vec::new();
    for robot in &run.robots {
        let Some(settings) = &robot.settings else {
            continue;
        };
        match groups.iter_mut().find(|(known, _)| *known == settings) {
            Some((_, names)) => names.push(&robot.name),
            None => groups.push((settings, vec![&robot.name])),
        }
    }
    let groups = groups.into_iter().filter_map(|(settings, names)| {
        let config = Config::new(settings.clone()).ok()?;
        Some((names.join(", "), bounds(&config, USUAL_DELAY)))
    });
    let groups: Vec<_> = groups.collect();
    (!groups.is_empty()).then(|| {
        html! {
            @for (names, bounds) in groups {
                div.scroll tabindex="0" role="group" aria-label="Longest times" {
                    table {
                        caption { (names) }
                        thead { tr { th scope="col" { "from what to what" } th.n scope="col" { "at most [ms]" } th scope="col" { "property" } th scope="col" { "how it follows" } } }
                        tbody {
                            @for bound in bounds {
                                tr {
                                    th scope="row" { (bound.name) }
                                    td.n { (bound.ms) }
                                    td { (bound.properties) }
                                    td { (bound.derivation) }
                                }
                            }
                        }
                    }
                }
            }
            p.faint { "For any run with these settings, not measured in this one: where a message takes at most " (USUAL_DELAY.0) " ms, and without the time in which a body stops. crossguard bounds has the terms." }
        }
    })
}
