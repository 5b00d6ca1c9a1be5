//! Finds the axes of an NRRD file that are those of the grid.

use super::fields::Header;
use crate::error::Error;
use crate::segments::has_segments;
use crate::text::{listed, shown};

const GRID_KINDS: [&str; 5] = ["domain", "space", "none", "???", ""];

pub(crate) struct Axes {
    pub(crate) sizes: Vec<u64>,
    pub(crate) of_grid: [usize; 3],
    /// Length of the fourth axis: 1, except for a segmentation in layers.
    pub(crate) layers: u64,
    /// Number of grid axes that vary faster than the axis of the layers.
    pub(crate) after: usize,
}

impl Header<'_> {
    pub(crate) fn axes(&self) -> Result<Axes, Box<Error>> {
        self.required("sizes")?;
        let stated = self.sizes()?;
        self.required("dimension")?;
        let has_dimension = i64::try_from(stated.len()) == Ok(self.whole("dimension")?);
        if !has_dimension || stated.len() < 3 || stated.iter().any(|&size| size < 1) {
            let found = format!("sizes: {}", shown(&listed(&stated)));
            return Err(Error::new(self.path, found, "3 axes, none empty"));
        }
        let sizes: Vec<u64> = stated.iter().map(|size| size.cast_unsigned()).collect();
        let axes = self.with_direction(&sizes)?;
        let others: Vec<usize> =
            (0..sizes.len()).filter(|axis| !axes.iter().take(3).any(|one| one == axis)).collect();
        let long: Vec<usize> = others.into_iter().filter(|&axis| sizes[axis] != 1).collect();
        let is_in_layers = has_segments(&self.lines);
        let kinds: Vec<&str> = self.text("kinds").split_whitespace().collect();
        let of_grid = <[usize; 3]>::try_from(axes);
        let Some(of_grid) = of_grid.ok().filter(|_| long.len() <= usize::from(is_in_layers)) else {
            let kinds = shown(&kinds.join(" "));
            let kinds = if kinds.is_empty() { "not stated" } else { &kinds };
            let sizes = shown(&listed(&sizes));
            let found = format!("several values per voxel or time points (sizes: {sizes}, kinds: {kinds})");
            let error = Error::new(self.path, found, "3 axes with a direction");
            return Err(error.mend("write one component or time point"));
        };
        self.require_grid_axes(of_grid, &kinds)?;
        let layers = long.first().map_or(1, |&axis| sizes[axis]);
        let after = long.first().map_or(0, |&axis| of_grid.iter().filter(|&&one| one < axis).count());
        Ok(Axes { sizes, of_grid, layers, after })
    }

    fn with_direction(&self, sizes: &[u64]) -> Result<Vec<usize>, Box<Error>> {
        let count = sizes.len();
        Ok(match self.directions()? {
            Some(directions) if directions.len() == count => {
                (0..count).filter(|&axis| directions[axis].is_some()).collect()
            }
            _ if count > 3 => {
                (0..count).filter(|&axis| sizes[axis] > 1 || count - axis <= 3).take(3).collect()
            }
            _ => (0..count).collect(),
        })
    }

    fn require_grid_axes(&self, axes: [usize; 3], kinds: &[&str]) -> Result<(), Box<Error>> {
        let is_odd = |kind: &&&str| !GRID_KINDS.contains(&kind.to_ascii_lowercase().as_str());
        match axes.iter().filter_map(|&axis| kinds.get(axis)).find(is_odd) {
            None => Ok(()),
            Some(kind) => {
                let found = format!("an axis of kind {}", shown(kind));
                Err(Error::new(self.path, found, "domain or space axes").mend("write one component"))
            }
        }
    }
}
