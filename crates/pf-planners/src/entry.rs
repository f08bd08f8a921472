use crate::{FromScene, Runner, runner::On};
use pf_core::{Claims, InvalidParams, Key, Params, Problem, Replanner, Trace};
use pf_external::Fault;
use pf_render::Recorder;
use std::fmt;

/// Parameters by name and value, in the order they were given.
pub type Settings = [(String, String)];

/// A planner for the problem `P`, by name.
pub struct Entry<P: Problem> {
    pub(crate) key: &'static str,
    pub(crate) source: &'static str,
    pub(crate) parameters: &'static [Key],
    pub(crate) replans: bool,
    pub(crate) make: Make<P>,
}

type Make<P> = fn(&Settings) -> Result<Box<dyn Replanner<P>>, InvalidParams>;

impl<P: Problem> Entry<P> {
    /// The name on the command line.
    #[must_use]
    pub fn key(&self) -> &'static str {
        self.key
    }

    /// Where it was published.
    #[must_use]
    pub fn source(&self) -> &'static str {
        self.source
    }

    /// What can be set.
    #[must_use]
    pub fn parameters(&self) -> &'static [Key] {
        self.parameters
    }

    /// Whether it repairs its answers; otherwise it starts over after a change.
    #[must_use]
    pub fn replans(&self) -> bool {
        self.replans
    }

    /// A new planner with these settings; the others are at their defaults.
    ///
    /// # Errors
    /// [`InvalidParams`] if a setting is unknown or makes no sense.
    pub fn make(&self, settings: &Settings) -> Result<Box<dyn Replanner<P>>, InvalidParams> {
        (self.make)(settings)
    }
}

impl<P: Problem> fmt::Debug for Entry<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Entry({})", self.key)
    }
}

/// A planner by name, whatever its problem.
pub trait AnyEntry: fmt::Debug {
    /// The name on the command line.
    fn key(&self) -> &'static str;
    /// The name the literature uses.
    fn name(&self) -> String;
    /// The problem it solves: `grid`, `world`.
    fn problem(&self) -> &'static str;
    /// What it promises at its default settings.
    fn claims(&self) -> Claims;
    /// Where it was published.
    fn source(&self) -> &'static str;
    /// What can be set.
    fn parameters(&self) -> &'static [Key];
    /// Whether it repairs its answers; otherwise it starts over after a change.
    fn replans(&self) -> bool;
    /// A new planner with these settings, behind a door that hides its problem.
    ///
    /// # Errors
    /// [`InvalidParams`] if a setting is unknown or makes no sense.
    fn runner(&self, settings: &Settings) -> Result<Box<dyn Runner>, InvalidParams>;
}

impl<P: FromScene + 'static> AnyEntry for Entry<P>
where
    Recorder: Trace<P>,
{
    fn key(&self) -> &'static str {
        self.key
    }
    fn name(&self) -> String {
        let planner = self.make(&[]);
        planner.map_or_else(|_| self.key.to_owned(), |planner| planner.name().to_owned())
    }
    fn problem(&self) -> &'static str {
        P::KIND
    }
    fn claims(&self) -> Claims {
        let planner = self.make(&[]);
        planner.map_or(Claims::NONE, |planner| planner.claims())
    }
    fn source(&self) -> &'static str {
        self.source
    }
    fn parameters(&self) -> &'static [Key] {
        self.parameters
    }
    fn replans(&self) -> bool {
        self.replans
    }
    fn runner(&self, settings: &Settings) -> Result<Box<dyn Runner>, InvalidParams> {
        Ok(Box::new(On::new(self.make(settings)?)))
    }
}

/// The defaults with `settings` in place.
pub(crate) fn configured<T: Params + Default>(settings: &Settings) -> Result<T, InvalidParams> {
    let mut params = T::default();
    for (key, value) in settings {
        params.set(key, value)?;
    }
    Ok(params)
}

/// An entry: `replans` for a planner that repairs its answers, `plans` for one that starts over.
macro_rules! entry {
    (replans $key:literal, $planner:ty, $params:ty, $source:literal) => {
        entry!(@ true, $key, $planner, $params, $source, |planner| planner)
    };
    (plans $key:literal, $planner:ty, $params:ty, $source:literal) => {
        entry!(@ false, $key, $planner, $params, $source, pf_core::FromScratch)
    };
    (@ $replans:literal, $key:literal, $planner:ty, $params:ty, $source:literal, $wrap:expr) => {
        $crate::Entry {
            key: $key,
            source: $source,
            parameters: <$params as pf_core::Params>::KEYS,
            replans: $replans,
            make: |settings| {
                let params: $params = $crate::entry::configured(settings)?;
                let planner = <$planner>::new(params)?;
                Ok(Box::new($wrap(planner)))
            },
        }
    };
}

pub(crate) use entry;

/// There is no planner of that name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownPlanner {
    asked: String,
    near: Option<&'static str>,
    known: Vec<&'static str>,
    /// What its program did wrong, if it is one.
    fault: Option<String>,
}

impl UnknownPlanner {
    pub(crate) fn silent(asked: &str, fault: &Fault) -> Self {
        Self {
            asked: asked.to_owned(),
            near: None,
            known: Vec::new(),
            fault: Some(fault.to_string()),
        }
    }

    pub(crate) fn new(asked: &str, known: impl Iterator<Item = &'static str>) -> Self {
        let known: Vec<_> = known.collect();
        let likeness = |key: &str| strsim::jaro_winkler(&asked.to_lowercase(), key);
        let nearest = known
            .iter()
            .map(|key| (likeness(key), *key))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        Self {
            asked: asked.to_owned(),
            near: nearest
                .filter(|(likeness, _)| *likeness > 0.75)
                .map(|(_, key)| key),
            known,
            fault: None,
        }
    }

    /// The name that was probably meant.
    #[must_use]
    pub fn near(&self) -> Option<&'static str> {
        self.near
    }

    /// The names there are.
    #[must_use]
    pub fn known(&self) -> &[&'static str] {
        &self.known
    }
}

impl fmt::Display for UnknownPlanner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(fault) = &self.fault {
            return write!(f, "{}: {fault}", self.asked);
        }
        write!(f, "there is no planner `{}`; ", self.asked)?;
        if let Some(near) = self.near {
            write!(f, "did you mean `{near}`? ")?;
        }
        write!(f, "Known: {}", self.known.join(", "))
    }
}

impl std::error::Error for UnknownPlanner {}
