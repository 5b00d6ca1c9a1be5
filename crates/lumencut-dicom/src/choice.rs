//! Chooses the series that is read.

use crate::describing::described;
use crate::error::{Error, ErrorKind, Result};
use crate::mend::Mend;
use crate::report::Report;
use crate::series::{Series, plain};
use crate::wording::{listed, quoted};

/// The requested series, or the only one, or the only one that can be an angiography volume.
pub(crate) fn chosen<'s, 'a>(
    every: &'s [Series<'a>],
    wanted: Option<&str>,
    notes: &mut Vec<String>,
) -> Result<&'s Series<'a>> {
    if let Some(wanted) = wanted {
        return asked_for(every, wanted);
    }
    if let [only] = every {
        return Ok(only);
    }
    let reports: Vec<Report> = every.iter().map(described).collect();
    let (volumes, others): (Vec<usize>, Vec<usize>) =
        (0..every.len()).partition(|&n| reports[n].can_be_volume);
    let [one] = volumes[..] else {
        return Err(not_one(reports, "one series"));
    };
    let others: Vec<String> = others.iter().map(|&n| reports[n].to_string()).collect();
    notes.push(format!("of {} series the only angiography volume is read: {}", every.len(), reports[one]));
    notes.push(format!("other series: {}", listed(&others)));
    Ok(&every[one])
}

fn asked_for<'s, 'a>(every: &'s [Series<'a>], wanted: &str) -> Result<&'s Series<'a>> {
    let is_meant = |one: &&Series| {
        let number = one.number();
        one.has_uid(wanted) || wanted == number || plain(wanted) == number
    };
    let meant: Vec<&Series> = every.iter().filter(is_meant).collect();
    if let [one] = meant[..] {
        return Ok(one);
    }
    let of: Vec<&Series> = if meant.is_empty() { every.iter().collect() } else { meant };
    let expected = format!("one series with the number or UID {}", quoted(wanted));
    Err(not_one(of.into_iter().map(described).collect(), &expected))
}

fn not_one(series: Vec<Report>, expected: &str) -> Error {
    // Possible volumes are listed first, because users choose among them.
    let (volumes, others): (Vec<&Report>, Vec<&Report>) = series.iter().partition(|one| one.can_be_volume);
    let reports: Vec<String> = volumes.into_iter().chain(others).map(ToString::to_string).collect();
    let error = Error::new(format!("{} series: {}", series.len(), listed(&reports)), expected);
    let error = error.mend("give the folder of one series").mended_by(Mend::Series);
    Error { kind: ErrorKind::Series, series: series.into(), ..error }
}
