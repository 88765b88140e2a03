//! Answers of commands, and statements of the repository's pages.

mod attack;
mod check;
mod ci_example;
mod cmd;
mod commanded;
mod cut_short;
mod demo;
mod full_disk;
mod keys;
mod odds_frequencies;
mod pages;
mod readers;
mod report;
mod safety;
mod security;
mod sim;
mod simulate;
mod site;
mod sniff;
mod studio;
mod validate;
mod workers;
