//! Every law that binds them.

use pf_classic::{AStar, Auto, DStarLite, Dijkstra, Jps, Prepared, VisibilityGraph};
use pf_conformance::{grid, world};
use pf_core::FromScratch;

#[test]
fn a_star_keeps_the_laws() {
    grid::check_replanner(|| FromScratch(AStar::default()));
}

#[test]
fn dijkstra_keeps_the_laws() {
    grid::check_replanner(|| FromScratch(Dijkstra::default()));
}

#[test]
fn d_star_lite_keeps_the_laws() {
    grid::check_replanner(DStarLite::default);
}

#[test]
fn jump_point_search_keeps_the_laws() {
    grid::check_replanner(Jps::default);
}

#[test]
fn the_choice_keeps_the_laws() {
    grid::check_replanner(Auto::default);
}

#[test]
fn prepared_jumps_keep_the_laws() {
    grid::check_replanner(Prepared::default);
}

#[test]
fn the_visibility_graph_keeps_the_laws() {
    world::check_replanner(VisibilityGraph::default);
}
