//! Parameters by name, for command lines and scenario files, without serde.

use std::{fmt, ops::RangeInclusive};

/// One parameter that [`Params::set`] knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// What it means, with its unit.
    pub about: &'static str,
}

/// A set of parameters whose members can be set by name.
///
/// Use [`params!`](crate::params) to implement it.
pub trait Params {
    /// The names there are.
    const KEYS: &'static [Key];

    /// Sets the parameter called `key`.
    ///
    /// # Errors
    /// [`InvalidParams`] if there is none of that name, or `value` cannot be read as its type.
    fn set(&mut self, key: &str, value: &str) -> Result<(), InvalidParams>;
}

impl Params for () {
    const KEYS: &'static [Key] = &[];

    fn set(&mut self, key: &str, _: &str) -> Result<(), InvalidParams> {
        Err(InvalidParams::unknown::<Self>(key))
    }
}

/// A parameter that makes no sense.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidParams {
    /// There is no parameter of that name.
    #[error("there is no parameter `{key}`; known: {}", list(.known))]
    UnknownKey {
        /// The name asked for.
        key: String,
        /// The names there are.
        known: &'static [Key],
    },
    /// The value does not fit the parameter.
    #[error("parameter `{key}`: `{value}` is not {expected}")]
    BadValue {
        /// The parameter.
        key: String,
        /// What was given.
        value: String,
        /// What would fit.
        expected: String,
    },
}

impl InvalidParams {
    /// No parameter of `P` is called `key`.
    #[must_use]
    pub fn unknown<P: Params>(key: &str) -> Self {
        Self::UnknownKey {
            key: key.to_owned(),
            known: P::KEYS,
        }
    }

    /// `value` does not fit the parameter `key`.
    #[must_use]
    pub fn bad(key: &str, value: &str, expected: impl Into<String>) -> Self {
        Self::BadValue {
            key: key.to_owned(),
            value: value.to_owned(),
            expected: expected.into(),
        }
    }

    /// Refuses a value that is not `fine`.
    ///
    /// # Errors
    /// [`BadValue`](Self::BadValue) then.
    pub fn unless(
        key: &str,
        value: impl fmt::Display,
        fine: bool,
        expected: &str,
    ) -> Result<(), Self> {
        if fine {
            return Ok(());
        }
        Err(Self::bad(key, &value.to_string(), expected))
    }

    /// Refuses a whole number out of a range.
    ///
    /// # Errors
    /// [`BadValue`](Self::BadValue) then, with the range.
    ///
    /// ```
    /// # use pf_core::InvalidParams;
    /// assert_eq!(InvalidParams::unless_whole("ants", 5, 1..=9), Ok(()));
    /// let error = InvalidParams::unless_whole("ants", 0, 1..=9).unwrap_err();
    /// assert_eq!(error.to_string(), "parameter `ants`: `0` is not a whole number from 1 to 9");
    /// ```
    pub fn unless_whole<T: Copy + PartialOrd + fmt::Display>(
        key: &str,
        value: T,
        range: RangeInclusive<T>,
    ) -> Result<(), Self> {
        if range.contains(&value) {
            return Ok(());
        }
        let expected = format!("a whole number from {} to {}", range.start(), range.end());
        Err(Self::bad(key, &value.to_string(), expected))
    }
}

fn list(keys: &[Key]) -> String {
    if keys.is_empty() {
        return "none".to_owned();
    }
    let names: Vec<_> = keys.iter().map(|k| k.name).collect();
    names.join(", ")
}

/// Implements [`Params`] for a struct: one line per field that can be set by name.
///
/// ```
/// # use pf_core::{Params, params};
/// #[derive(Default)]
/// struct AntParams { ants: usize, alpha: f64 }
/// params!(AntParams {
///     ants: usize = "ants per iteration",
///     alpha: f64 = "exponent of the straight distance to the goal",
/// });
///
/// let mut params = AntParams::default();
/// params.set("alpha", "8").unwrap();
/// assert_eq!(params.alpha, 8.0);
/// let error = params.set("rho", "0.1").unwrap_err();
/// assert_eq!(error.to_string(), "there is no parameter `rho`; known: ants, alpha");
/// let error = params.set("ants", "many").unwrap_err();
/// assert_eq!(error.to_string(), "parameter `ants`: `many` is not a value of type usize");
/// ```
#[macro_export]
macro_rules! params {
    ($params:ty { $($field:ident: $kind:ty = $about:literal),* $(,)? }) => {
        impl $crate::Params for $params {
            const KEYS: &'static [$crate::Key] =
                &[$($crate::Key { name: stringify!($field), about: $about }),*];

            fn set(&mut self, key: &str, value: &str) -> Result<(), $crate::InvalidParams> {
                match key {
                    $(stringify!($field) => {
                        self.$field = value.parse::<$kind>().map_err(|_| {
                            let expected = concat!("a value of type ", stringify!($kind));
                            $crate::InvalidParams::bad(key, value, expected)
                        })?;
                        Ok(())
                    })*
                    _ => Err($crate::InvalidParams::unknown::<Self>(key)),
                }
            }
        }
    };
}

/// Gives an enum words for its values, to be read and written.
///
/// ```
/// # use pf_core::words;
/// #[derive(Debug, PartialEq)]
/// enum Size { Small, Large }
/// words!(Size { "small" = Small, "large" = Large });
///
/// assert_eq!("large".parse(), Ok(Size::Large));
/// assert_eq!(Size::Small.to_string(), "small");
/// assert_eq!("huge".parse::<Size>(), Err("small, large".to_owned()));
/// ```
#[macro_export]
macro_rules! words {
    ($kind:ident { $($word:literal = $value:ident),* $(,)? }) => {
        impl ::core::str::FromStr for $kind {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, String> {
                match text {
                    $($word => Ok(Self::$value),)*
                    _ => Err([$($word),*].join(", ")),
                }
            }
        }

        impl ::core::fmt::Display for $kind {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.write_str(match self {
                    $(Self::$value => $word),*
                })
            }
        }
    };
}
