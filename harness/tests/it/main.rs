//! What commands answer, and what the repository's pages say.

mod ages;
mod attack;
mod check;
mod ci_example;
mod cmd;
mod cut_short;
mod demo;
mod full_disk;
mod keys;
mod pages;
mod people;
mod readers;
mod safety;
mod security;
mod studio;
