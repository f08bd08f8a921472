//! The maps that the program carries, and questions worth asking on them.

use crate::{
    args::QuestionArgs,
    failure::Failure,
    question::{self, Question},
    team,
};
use pf_geom::{Point, TeamProblem};
use pf_grid::{Cell, Grid, Moves};
use pf_io::{
    AnyScenario, GridMap, Unknown, parse_movingai, parse_ros, parse_scenario, parse_world,
    parse_world_scenario,
};
use pf_planners::{GridScene, Robot, Scene, WorldScene};

macro_rules! carried {
    ($path:literal) => {
        include_bytes!(concat!("../../../../maps/", $path))
    };
}

/// A map, and what every planner is asked on it.
pub(super) struct Show {
    pub(super) name: &'static str,
    pub(super) about: &'static str,
    pub(super) scene: fn() -> Result<Scene, Failure>,
}

pub(super) const SHOWS: &[Show] = &[
    Show {
        name: "mosaic",
        about: "A grid of 100 x 100 cells. Planners in worlds see its blocked cells as rectangles \
                and go straight in all directions.",
        scene: || {
            let map = parse_movingai("mosaic", carried!("grids/redlarski/mosaic-100.map"))?;
            let scene = GridScene::new(map, Cell::new(2, 54), Cell::new(97, 54))?;
            Ok(scene.with_moves(Moves::Always).into())
        },
    },
    Show {
        name: "square",
        about: "A world of shapes. Planners on grids see it cut into cells, blocked where an \
                obstacle is. The bees (cABC) do not know the world: they see a small square.",
        scene: || {
            let square = parse_world("square", carried!("worlds/cabc-2.toml"))?;
            let (from, to) = (Point::new(3.0, 3.0), Point::new(47.0, 40.0));
            let scene = WorldScene::new(square.world, Robot::default(), from, to)?;
            Ok(scene.with_cell(1.0)?.into())
        },
    },
];

/// A team of three robots.
pub(super) fn robots() -> Result<TeamProblem, Failure> {
    let file = parse_world("three-robots", carried!("scenarios/three-robots.toml"))?;
    Ok(TeamProblem::new(file.world.clone(), team::robots(&file))?)
}

/// A scenario in time, and who plans anew.
pub(super) struct Play {
    pub(super) name: &'static str,
    pub(super) planner: &'static str,
    pub(super) about: &'static str,
    pub(super) question: fn() -> Result<Option<Question>, Failure>,
}

pub(super) const PLAYS: &[Play] = &[
    Play {
        name: "closing doors",
        planner: "d-star-lite",
        about: "A robot with a radius of three cells plans a way through an office while doors close \
                and open, a chair is moved and the floor is mopped. D* Lite repairs what it knows.",
        question: || {
            let mut load = |_: &str, _: &_| {
                Ok(GridMap {
                    grid: office()?.into(),
                    frame: None,
                    source: "office.yaml".into(),
                })
            };
            let bytes = carried!("scenarios/closing-doors.toml");
            let scenario = parse_scenario("closing-doors", bytes, &mut load)?;
            first("closing-doors", AnyScenario::Grid(scenario))
        },
    },
    Play {
        name: "yard traffic",
        planner: "visibility-graph",
        about: "A courier crosses a freight yard while a forklift drives about and gates close. The \
                visibility graph keeps its tangents while only start and goal move.",
        question: || {
            let mut load = |_: &str, _: &_| parse_world("yard.toml", carried!("worlds/yard.toml"));
            let bytes = carried!("scenarios/yard-traffic.toml");
            let scenario = parse_world_scenario("yard-traffic", bytes, &mut load)?;
            first("yard-traffic", AnyScenario::World(scenario))
        },
    },
];

fn office() -> Result<Grid, pf_io::FileError> {
    let yaml = parse_ros("office.yaml", carried!("grids/office.yaml"))?;
    let pgm = carried!("grids/office.pgm");
    yaml.grid("office.pgm", pgm, Unknown::Blocked)
}

fn first(name: &str, scenario: AnyScenario) -> Result<Option<Question>, Failure> {
    let questions = question::played(name, scenario, &QuestionArgs::default(), true)?;
    Ok(questions.into_iter().next())
}
