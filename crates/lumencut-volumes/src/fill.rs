//! Converts the bytes of a file to voxels, in pieces of bounded size. A small file cannot make it request much
//! memory.

mod pass;

use crate::convert::{Conversion, widened};
use crate::error::Error;
use crate::label_map::LabelMap;
use crate::numbers::Kind;
use crate::plan::{Plan, Stored};
use crate::stream::Codec;
use pass::{Pass, Piece};

const READ: u64 = 1 << 20;
const PIECE: usize = 1 << 18;
/// A byte of a deflate stream unpacks to at most this many bytes.
const DEFLATE_LIMIT: u128 = 1032;
/// Up to this multiple of the compressed size, memory is requested before the stream has proved its length.
const TRUSTED: u128 = 8;
/// Unpacked bytes that may follow the voxels: this many, the voxels' own, or what a trusted stream has.
const BEYOND: u64 = 1 << 30;

/// A part of the file that holds the voxels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Window<'a> {
    /// The first byte.
    pub start: u64,
    /// The bytes from `start` on, as many as the host has.
    pub bytes: &'a [u8],
}

/// What a step of [`Fill`] did or needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The next step needs the bytes of the file from `start` to `end`. It accepts more, and fewer at the end of the
    /// file.
    Read {
        /// The first byte.
        start: u64,
        /// The byte after the last one.
        end: u64,
    },
    /// The length of the file is plausible.
    Sound {
        /// Whether the length proves that the file holds all voxels.
        is_proven: bool,
        /// Bytes of the voxels in the smallest type that they may have.
        least: u64,
    },
    /// This many stored bytes were examined, before any voxel is written or after the last one.
    Checked(usize),
    /// The next steps write the voxels; the host provides memory.
    Room {
        /// The type of the voxels.
        kind: Kind,
        /// Bytes of all voxels.
        bytes: u64,
    },
    /// This many bytes were written to the start of the output: complete numbers, unless the output was too short.
    Filled(usize),
    /// All voxels are written, and checksums match.
    Done,
}

enum Phase {
    Lines { left: u64 },
    Lengths,
    Proof(Pass),
    Range(Pass, (i128, i128)),
    Room(Kind),
    Copy(Pass),
    Convert(Pass, Conversion),
    Map(Pass, Box<LabelMap>),
    Done,
}

/// Reads the voxels of a volume step by step; the host calls [`Fill::step`] and provides what it needs.
pub struct Fill {
    plan: Plan,
    in_engine: bool,
    size: u64,
    at: u64,
    asked: Option<u64>,
    phase: Phase,
    buffer: Vec<u8>,
    held: usize,
}

impl Fill {
    /// Begins to read the voxels of a `plan` from [`crate::open`]; `size` is that of the file of voxels (bytes). With
    /// `in_engine` voxels get a type of the engine (uint8, int16, uint16 or float32), else one that holds them exactly.
    /// They are in this machine's byte order, i fastest.
    #[must_use]
    pub fn new(plan: Plan, size: u64, in_engine: bool) -> Self {
        let phase = Phase::Lines { left: plan.place.lines };
        let at = plan.place.start.unwrap_or(0);
        Self { plan, in_engine, size, at, asked: None, phase, buffer: Vec::new(), held: 0 }
    }

    /// Takes one step. `window` holds the bytes of the last [`Step::Read`], or the entire file; it is empty at first.
    /// Voxels are written to `output`: at least 8 bytes after [`Step::Room`], else empty. Fails for a file that is too
    /// short or damaged, and for segments that overlap.
    pub fn step(&mut self, window: Window<'_>, output: &mut [u8]) -> Result<Step, Box<Error>> {
        loop {
            let skipped = usize::try_from(self.at.saturating_sub(window.start)).unwrap_or(usize::MAX);
            let is_before = self.at < window.start;
            let input = if is_before { &[] } else { window.bytes.get(skipped..).unwrap_or_default() };
            match self.turn(input, output)? {
                Turn::Again => {}
                Turn::Hungry if self.asked == Some(self.at) => {
                    // The file has become shorter since its size was read.
                    self.size = self.at + input.len() as u64;
                }
                Turn::Hungry => {
                    let end = self.at.saturating_add(READ).min(self.size);
                    self.asked = Some(self.at);
                    return Ok(Step::Read { start: self.at, end });
                }
                Turn::Step(step) => return Ok(step),
            }
        }
    }

    fn turn(&mut self, input: &[u8], output: &mut [u8]) -> Result<Turn, Box<Error>> {
        match &mut self.phase {
            Phase::Lines { left } => {
                let is_over = self.at >= self.size;
                if *left == 0 || is_over {
                    self.phase = Phase::Lengths;
                } else if input.is_empty() {
                    return Ok(Turn::Hungry);
                } else {
                    let (lines, bytes) = lines_in(input, *left);
                    *left -= lines;
                    self.at += bytes as u64;
                }
                Ok(Turn::Again)
            }
            Phase::Lengths => self.check_lengths(),
            Phase::Proof(_) | Phase::Range(..) => self.look(input),
            Phase::Room(kind) => {
                let kind = *kind;
                self.phase = self.filling(kind)?;
                let bytes = saturated(self.plan.voxels().saturating_mul(kind.bytes() as u128));
                Ok(Turn::Step(Step::Room { kind, bytes }))
            }
            Phase::Copy(pass) => {
                let piece = pass.take(&mut self.at, self.size, input, output)?;
                Ok(self.after(piece, Step::Filled))
            }
            Phase::Convert(..) => self.convert(input, output),
            Phase::Map(..) => self.map(input, output),
            Phase::Done => Ok(Turn::Step(Step::Done)),
        }
    }

    fn after(&mut self, piece: Piece, step: fn(usize) -> Step) -> Turn {
        match piece {
            Piece::Bytes(0) | Piece::Beyond(0) => Turn::Again,
            Piece::Bytes(count) => Turn::Step(step(count)),
            Piece::Beyond(count) => Turn::Step(Step::Checked(count)),
            Piece::Hungry => Turn::Hungry,
            Piece::Full => Turn::Step(step(0)),
            Piece::End => {
                self.phase = Phase::Done;
                Turn::Again
            }
        }
    }

    fn check_lengths(&mut self) -> Result<Turn, Box<Error>> {
        let (place, needed) = (&self.plan.place, self.plan.stored_bytes());
        let (name, skip) = (place.name.as_str(), u128::from(place.skip));
        let held = u128::from(self.size.saturating_sub(self.at));
        match (place.codec, place.start) {
            (Codec::Raw, None) => {
                if held < needed {
                    return Err(Error::too_short(name, "", held, needed));
                }
                self.at = self.size - saturated(needed);
            }
            (Codec::Raw, _) if held < skip.saturating_add(needed) => {
                return Err(Error::too_short(name, "", held.saturating_sub(skip), needed));
            }
            (Codec::Raw, _) => self.at += place.skip,
            (Codec::Text, _) => {
                self.at = self.at.saturating_add(place.skip);
                let (held, least) = (held.saturating_sub(skip), self.numbers().saturating_mul(2) - 1);
                if held < least {
                    return Err(Error::too_short(name, "", held, least));
                }
            }
            (Codec::Zlib, _) if skip.saturating_add(needed) > held * DEFLATE_LIMIT => {
                return Err(Error::too_short(name, "at most ", held * DEFLATE_LIMIT, needed));
            }
            (Codec::Zlib | Codec::Bzip2, _) => {}
        }
        self.plan.grid.check(&self.plan.name, self.plan.grid.size)?;
        self.phase = self.first_pass(held);
        let kind = self.plan.settled(self.in_engine);
        let smallest = if self.in_engine { 1 } else { self.plan.stored.kind.bytes() };
        let least = self.plan.voxels().saturating_mul(kind.map_or(smallest, Kind::bytes) as u128);
        let is_proven = self.plan.place.codec == Codec::Raw;
        Ok(Turn::Step(Step::Sound { is_proven, least: saturated(least) }))
    }

    fn numbers(&self) -> u128 {
        self.plan.stored_bytes() / self.plan.stored.kind.bytes() as u128
    }

    /// A pass over all stored numbers before voxels are written: to find their range, or to prove that a stream holds
    /// them.
    fn first_pass(&self, held: u128) -> Phase {
        let needed = self.plan.stored_bytes().saturating_add(self.plan.place.skip.into());
        let is_packed = matches!(self.plan.place.codec, Codec::Zlib | Codec::Bzip2);
        match self.plan.settled(self.in_engine) {
            None => Phase::Range(self.pass(), (i128::MAX, i128::MIN)),
            Some(_) if is_packed && needed > TRUSTED * held => Phase::Proof(self.pass()),
            Some(kind) => Phase::Room(kind),
        }
    }

    fn pass(&self) -> Pass {
        let needed = self.plan.stored_bytes();
        let trusted = TRUSTED * u128::from(self.size.saturating_sub(self.at));
        let beyond = saturated(needed.max(trusted)).max(BEYOND);
        Pass::new(&self.plan, self.at, needed, self.numbers(), beyond)
    }

    /// How numbers are stored when a pass returns them: those of a text are in this machine's byte order.
    fn stored(&self) -> Stored {
        let is_text = self.plan.place.codec == Codec::Text;
        let is_big = if is_text { cfg!(target_endian = "big") } else { self.plan.stored.is_big };
        Stored { is_big, ..self.plan.stored }
    }

    fn look(&mut self, input: &[u8]) -> Result<Turn, Box<Error>> {
        self.buffer.resize(PIECE, 0);
        let stored = self.stored();
        let (Phase::Proof(pass) | Phase::Range(pass, _)) = &mut self.phase else { return Ok(Turn::Again) };
        let start = pass.start;
        let piece = pass.take(&mut self.at, self.size, input, &mut self.buffer[self.held..])?;
        let Piece::Bytes(count) = piece else {
            if matches!(piece, Piece::Hungry | Piece::Beyond(_)) {
                return Ok(self.after(piece, Step::Checked));
            }
            let kind = match &self.phase {
                Phase::Range(_, range) => {
                    let kind = stored.scaling.kind_of(stored.kind, *range);
                    if self.in_engine { kind.in_the_engine() } else { kind }
                }
                _ => self.plan.settled(self.in_engine).unwrap_or(stored.kind),
            };
            (self.at, self.held) = (start, 0);
            self.phase = Phase::Room(kind);
            return Ok(Turn::Again);
        };
        if let Phase::Range(_, range) = &mut self.phase {
            let bytes = self.held + count;
            let whole = bytes - bytes % stored.kind.bytes();
            *range = widened(stored, &self.buffer[..whole], *range);
            self.buffer.copy_within(whole..bytes, 0);
            self.held = bytes - whole;
        }
        Ok(if count == 0 { Turn::Again } else { Turn::Step(Step::Checked(count)) })
    }

    fn filling(&mut self, kind: Kind) -> Result<Phase, Box<Error>> {
        let pass = self.pass();
        let conversion = Conversion::new(self.stored(), kind);
        Ok(match &self.plan.segmentation {
            Some(segmentation) if !segmentation.is_as_stored => {
                let stored = self.stored();
                let map = LabelMap::new(segmentation, self.plan.grid.size, stored).ok_or_else(|| {
                    Error::new(&self.plan.name, "more voxels than memory holds", "a volume that fits into it")
                })?;
                Phase::Map(pass, Box::new(map))
            }
            _ if conversion.is_copy() => Phase::Copy(pass),
            _ => Phase::Convert(pass, conversion),
        })
    }

    fn convert(&mut self, input: &[u8], output: &mut [u8]) -> Result<Turn, Box<Error>> {
        self.buffer.resize(PIECE, 0);
        let Phase::Convert(pass, conversion) = &mut self.phase else { return Ok(Turn::Again) };
        let (unit, size) = (self.plan.stored.kind.bytes(), conversion.kind().bytes());
        if self.held < unit {
            let piece = pass.take(&mut self.at, self.size, input, &mut self.buffer[self.held..])?;
            let Piece::Bytes(count) = piece else { return Ok(self.after(piece, Step::Filled)) };
            self.held += count;
        }
        let numbers = (self.held / unit).min(output.len() / size);
        if numbers == 0 && self.held >= unit {
            return Ok(Turn::Step(Step::Filled(0)));
        }
        let bytes = numbers * unit;
        conversion.convert(&self.buffer[..bytes], &mut output[..numbers * size]);
        self.buffer.copy_within(bytes..self.held, 0);
        self.held -= bytes;
        Ok(self.after(Piece::Bytes(numbers * size), Step::Filled))
    }

    fn map(&mut self, input: &[u8], output: &mut [u8]) -> Result<Turn, Box<Error>> {
        self.buffer.resize(PIECE, 0);
        let unit = self.plan.stored.kind.bytes();
        let Phase::Map(pass, map) = &mut self.phase else { return Ok(Turn::Again) };
        if map.has_labels() {
            return Ok(Turn::Step(Step::Filled(map.give(output))));
        }
        let taken = map.take(&self.buffer[..self.held - self.held % unit]);
        self.buffer.copy_within(taken..self.held, 0);
        self.held -= taken;
        if taken > 0 {
            return Ok(Turn::Again);
        }
        let piece = pass.take(&mut self.at, self.size, input, &mut self.buffer[self.held..])?;
        match piece {
            Piece::Bytes(count) => self.held += count,
            Piece::Hungry | Piece::Beyond(_) => return Ok(self.after(piece, Step::Filled)),
            Piece::Full => return Ok(Turn::Step(Step::Filled(0))),
            Piece::End => {
                map.refuse_overlaps(&self.plan.name)?;
                self.phase = Phase::Done;
            }
        }
        Ok(Turn::Again)
    }
}

enum Turn {
    Again,
    Hungry,
    Step(Step),
}

fn saturated(count: u128) -> u64 {
    u64::try_from(count).unwrap_or(u64::MAX)
}

/// The number of lines that end in these bytes, at most `most`, and the bytes up to the end of line `most`, else all.
fn lines_in(input: &[u8], most: u64) -> (u64, usize) {
    let mut lines = 0;
    for (at, &byte) in input.iter().enumerate() {
        if byte == b'\n' {
            lines += 1;
            if lines == most {
                return (lines, at + 1);
            }
        }
    }
    (lines, input.len())
}
