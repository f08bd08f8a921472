//! The planner that asks a program.

use crate::{
    Fault, Wire,
    program::{Program, Silence},
    wire::{Claim, Hello, Reply, Word},
};
use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Proof, Report, Unsupported, params,
};
use rand::Rng;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::{marker::PhantomData, time::Duration};

/// The key of the note that tells of a [`Fault`].
pub const FAULT: &str = "fault";

/// How much of a line that is no answer is shown.
const SHOWN: usize = 80;
/// How far a stated cost may be from the judge's, as a share: programs round what they print.
const ROUNDING: f64 = 1e-6;

/// How long a program may take to say who it is, before anybody could set a limit.
const INTRODUCTION: Duration = Duration::from_mins(1);

/// How an [`External`] planner is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct ExternalParams {
    /// How long a program may take to start, and to answer a question, in seconds.
    pub limit: f64,
}

params!(ExternalParams {
    limit: f64 = "seconds a program may take to start, and to answer",
});

impl Default for ExternalParams {
    /// Ten seconds.
    fn default() -> Self {
        Self { limit: 10.0 }
    }
}

impl ExternalParams {
    fn limit(&self) -> Result<Duration, InvalidParams> {
        let limit = Duration::try_from_secs_f64(self.limit);
        limit
            .ok()
            .filter(|limit| !limit.is_zero())
            .ok_or_else(|| InvalidParams::bad("limit", &self.limit.to_string(), "a time above 0 s"))
    }
}

/// A planner in another program.
///
/// One iteration is one question. The solution is marked by the problem's judge like that of any
/// planner; what went wrong is in the note [`FAULT`], and the outcome is unknown then.
#[derive(Debug)]
pub struct External<P> {
    command: String,
    limit: Duration,
    name: String,
    claims: Claims,
    program: Option<Program>,
    asked: u64,
    problem: PhantomData<fn(&P)>,
}

/// Starts a program and asks which problem it solves: `grid` or `world`.
fn greet(command: &str, limit: Duration) -> Result<(Program, Hello), Fault> {
    let mut program = Program::start(command)?;
    let line = match program.ask(line(&json!({ "pf": 1 })), limit, || true) {
        Ok(line) => line,
        Err(Silence::Fault(fault)) => return Err(fault),
        Err(Silence::Unwanted) => return Err(Fault::Hung { seconds: 0.0 }),
    };
    let expected = "an object with `name`, `problem` and perhaps `claims` (complete, optimal, \
                    deterministic)";
    let hello: Hello = read(&line, expected)?;
    Ok((program, hello))
}

/// What a program says of itself.
#[derive(Clone, Debug)]
pub struct Introduction {
    /// Its name.
    pub name: String,
    /// The problem it solves: `grid`, `world`.
    pub problem: String,
    /// What it promises.
    pub claims: Claims,
}

impl Introduction {
    /// Starts a program, lets it say who it is, and stops it.
    ///
    /// # Errors
    /// [`Fault`] if it does not start or does not say so.
    pub fn of(command: &str) -> Result<Self, Fault> {
        let (_, hello) = greet(command, INTRODUCTION)?;
        Ok(Self {
            claims: hello.claims(),
            name: hello.name,
            problem: hello.problem,
        })
    }
}

impl Hello {
    fn claims(&self) -> Claims {
        let add = |all: Claims, claim: &Claim| match claim {
            Claim::Complete => all.complete(),
            Claim::Optimal => all.optimal(),
            Claim::Deterministic => all.deterministic(),
        };
        self.claims.iter().fold(Claims::NONE, add)
    }
}

impl<P: Wire> External<P> {
    /// Starts a program: a name and arguments, quoted as in a shell.
    ///
    /// # Errors
    /// [`Fault`] if it does not start, does not say who it is, or solves another problem;
    /// [`InvalidParams`] inside, if the limit makes no sense.
    pub fn start(command: &str, params: &ExternalParams) -> Result<Self, Fault> {
        let limit = params.limit().map_err(|error| Fault::NotStarted {
            command: command.to_owned(),
            why: error.to_string(),
        })?;
        let (program, hello) = greet(command, limit)?;
        if hello.problem != P::KIND {
            return Err(Fault::Garbage {
                line: format!("\"problem\": \"{}\"", hello.problem),
                expected: format!("\"{}\"", P::KIND),
            });
        }
        Ok(Self {
            command: command.to_owned(),
            limit,
            claims: hello.claims(),
            name: hello.name,
            program: Some(program),
            asked: 0,
            problem: PhantomData,
        })
    }

    /// The program's answer to a problem; a program that did wrong is not asked again.
    fn ask(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Result<Reply, Silence> {
        let mut program = match self.program.take() {
            Some(program) => program,
            None => greet(&self.command, self.limit).map_err(Silence::Fault)?.0,
        };
        self.asked += 1;
        let mut question = problem.question();
        if let Value::Object(members) = &mut question {
            members.insert("id".into(), self.asked.into());
            members.insert("problem".into(), P::KIND.into());
            members.insert("seed".into(), cx.rng().next_u32().into());
        }
        let answer = program.ask(line(&question), self.limit, || !cx.is_over())?;
        let expected = "an object with `id`, `outcome` (optimal, feasible, infeasible, unknown) and, \
                        with a path, `path` ([[x, y], …])";
        let reply: Reply = read(&answer, expected).map_err(Silence::Fault)?;
        if reply.id != self.asked {
            return Err(Silence::Fault(Fault::Garbage {
                line: format!("\"id\": {}", reply.id),
                expected: format!("the question's, {}", self.asked),
            }));
        }
        self.program = Some(program);
        Ok(reply)
    }

    /// What a reply comes to, by the judge.
    fn mark(problem: &P, reply: Reply, cx: &mut Context<'_, P>) -> Result<Report<P>, Fault> {
        cx.visited(reply.expanded);
        cx.evaluated(reply.evaluated);
        for note in reply.notes {
            cx.note("says", note);
        }
        let proof = match reply.outcome {
            Word::Optimal => Proof::Optimal,
            Word::Feasible => Proof::None,
            Word::Infeasible => return Ok(cx.report(Outcome::Infeasible)),
            Word::Unknown => return Ok(cx.report(Outcome::Unknown { attempt: None })),
        };
        let path = reply
            .path
            .ok_or_else(|| Fault::BadPath("there is no `path`".into()))?;
        let solution = P::solution(&path).ok_or_else(|| {
            Fault::BadPath("its numbers are not columns and rows of a grid".into())
        })?;
        let cost = problem.judge(&solution);
        let judged = P::number(&cost.map_err(|violation| Fault::BadPath(violation.to_string()))?);
        // JSON knows no NaN.
        if let Some(said) = reply.cost
            && (said - judged).abs() > ROUNDING * judged.abs().max(1.0)
        {
            return Err(Fault::WrongCost { said, judged });
        }
        Ok(cx.answer(problem, solution, proof))
    }
}

impl<P: Wire> Planner<P> for External<P> {
    fn name(&self) -> &str {
        &self.name
    }

    fn claims(&self) -> Claims {
        self.claims
    }

    fn plan(&mut self, problem: &P, cx: &mut Context<'_, P>) -> Result<Report<P>, Unsupported> {
        let nothing = Outcome::Unknown { attempt: None };
        if !cx.proceed() {
            return Ok(cx.report(nothing));
        }
        let reply = self.ask(problem, cx);
        let fault = match reply.map(|reply| Self::mark(problem, reply, cx)) {
            Ok(Ok(report)) => return Ok(report),
            Ok(Err(fault)) | Err(Silence::Fault(fault)) => fault,
            Err(Silence::Unwanted) => return Ok(cx.report(nothing)),
        };
        self.program = None;
        // A budget that ends kills the program, too: that is no fault of its.
        if !cx.is_over() {
            cx.note(FAULT, format_args!("{} {fault}", self.name));
        }
        Ok(cx.report(nothing))
    }
}

fn line(question: &Value) -> Vec<u8> {
    format!("{question}\n").into_bytes()
}

fn read<T: DeserializeOwned>(line: &[u8], expected: &str) -> Result<T, Fault> {
    serde_json::from_slice(line).map_err(|error| {
        let text = String::from_utf8_lossy(line);
        let mut shown: String = text.trim_end().chars().take(SHOWN).collect();
        if shown.len() < text.trim_end().len() {
            shown.push('…');
        }
        Fault::Garbage {
            line: shown,
            expected: format!("{expected}: {error}"),
        }
    })
}
