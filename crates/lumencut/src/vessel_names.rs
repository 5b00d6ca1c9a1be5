//! Names of vessels that programs offer to users, with codes. Other names are allowed and have no code.

/// The side of a paired vessel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The patient's left side.
    Left,
    /// The patient's right side.
    Right,
}

impl Side {
    /// Both sides.
    pub const ALL: [Self; 2] = [Self::Left, Self::Right];

    /// SNOMED CT code and meaning.
    pub fn code(self) -> (&'static str, &'static str) {
        match self {
            Self::Left => ("7771000", "Left"),
            Self::Right => ("24028007", "Right"),
        }
    }

    fn of_word(word: &str) -> Option<Self> {
        match word {
            "l" | "left" => Some(Self::Left),
            "r" | "right" => Some(Self::Right),
            _ => None,
        }
    }
}

/// A named vessel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NamedVessel {
    /// The name in lower case, without a side.
    pub name: &'static str,
    /// Other complete names, in lower case.
    pub synonyms: &'static [&'static str],
    /// Whether the vessel exists on both sides of the body.
    pub is_paired: bool,
    /// Whether the name is offered to users; other names are only recognised.
    pub is_offered: bool,
    /// The part of the body: head, neck, heart, chest, abdomen, pelvis, arm or leg.
    pub region: &'static str,
    /// SNOMED CT code, from the context groups of DICOM PS3.16.
    pub snomed: &'static str,
    /// Meaning of the SNOMED CT code.
    pub meaning: &'static str,
    /// Number in the Foundational Model of Anatomy (323778 is `fma0323778`), from UBERON, BodyParts3D and HRA-VCCF.
    pub fma: Option<u32>,
}

impl NamedVessel {
    /// The names offered to users, with a capital letter; one per side for paired vessels.
    pub fn offered(&self) -> Vec<String> {
        match (self.is_offered, self.is_paired) {
            (false, _) => Vec::new(),
            (true, false) => vec![offered_name(self.name, None)],
            (true, true) => Side::ALL.map(|side| offered_name(self.name, Some(side))).to_vec(),
        }
    }

    fn is_called(&self, words: &str) -> bool {
        self.name == words || self.synonyms.contains(&words)
    }
}

/// A name of the table as it is offered to users.
pub(crate) fn offered_name(name: &str, side: Option<Side>) -> String {
    match side {
        Some(side) => format!("{} {name}", side.code().1),
        None => name[..1].to_uppercase() + &name[1..],
    }
}

/// The vessel that a name means, and its side. Only complete names match, such as `left renal artery`, `ICA R` or `LAD 2`.
pub fn vessel_named(name: &str) -> Option<(&'static NamedVessel, Option<Side>)> {
    let words = words_of(name);
    let called = |words: &[String]| {
        let name = words.join(" ");
        VESSEL_NAMES.iter().find(|vessel| vessel.is_called(&name))
    };
    let (first, last) = (words.first()?, words.last()?);
    if let Some(vessel) = called(&words) {
        return Some((vessel, None));
    }
    [(first, &words[1..]), (last, &words[..words.len() - 1])].into_iter().find_map(|(side, others)| {
        let side = Side::of_word(side)?;
        called(others).filter(|vessel| vessel.is_paired).map(|vessel| (vessel, Some(side)))
    })
}

/// Words in lower case, without a final number: that number counts the parts of a vessel.
fn words_of(name: &str) -> Vec<String> {
    let is_between = |letter: char| letter.is_whitespace() || "_-.,()".contains(letter);
    let name = name.to_lowercase();
    let mut words: Vec<String> =
        name.split(is_between).filter(|word| !word.is_empty()).map(str::to_owned).collect();
    if words.len() > 1 && words.last().is_some_and(|word| word.bytes().all(|byte| byte.is_ascii_digit())) {
        words.pop();
    }
    words
}

const SINGLE: NamedVessel = NamedVessel {
    name: "",
    synonyms: &[],
    is_paired: false,
    is_offered: true,
    region: "",
    snomed: "",
    meaning: "",
    fma: None,
};
const PAIRED: NamedVessel = NamedVessel { is_paired: true, ..SINGLE };

macro_rules! vessels {
    ($($kind:ident $region:literal $name:literal [$($synonym:literal),*] $snomed:literal $meaning:literal $fma:expr;)*) => {
        /// Vessels, from the heart outwards.
        pub const VESSEL_NAMES: &[NamedVessel] = &[$(NamedVessel {
            name: $name,
            synonyms: &[$($synonym),*],
            region: $region,
            snomed: $snomed,
            meaning: $meaning,
            fma: $fma,
            ..$kind
        }),*];
    };
}

const RECOGNISED: NamedVessel = NamedVessel { is_offered: false, ..SINGLE };
const RECOGNISED_PAIRED: NamedVessel = NamedVessel { is_offered: false, ..PAIRED };

vessels! {
    SINGLE "chest" "aorta" [] "15825003" "Aorta" Some(3734);
    SINGLE "chest" "ascending aorta" [] "54247002" "Ascending aorta" Some(3736);
    SINGLE "chest" "aortic arch" ["arch of aorta"] "57034009" "Aortic arch" Some(3768);
    SINGLE "chest" "descending thoracic aorta" [] "281130003" "Descending aorta" Some(87217);
    RECOGNISED "chest" "descending aorta" [] "281130003" "Descending aorta" Some(3784);
    RECOGNISED "chest" "thoracic aorta" [] "113262008" "Thoracic aorta" Some(3786);
    SINGLE "abdomen" "abdominal aorta" [] "7832008" "Abdominal aorta" Some(3789);
    SINGLE "heart" "left main coronary artery" ["left main", "lm"] "3227004" "Left Main Coronary Artery" None;
    SINGLE "heart" "left anterior descending artery" ["left anterior descending", "lad"]
        "59438005" "Left Anterior Descending Coronary Artery" Some(3862);
    SINGLE "heart" "circumflex artery" ["circumflex", "left circumflex", "left circumflex artery", "lcx"]
        "57396003" "Circumflex Coronary Artery" Some(3895);
    SINGLE "heart" "right coronary artery" ["right coronary", "rca"] "13647002" "Right Coronary Artery" Some(50039);
    SINGLE "chest" "pulmonary trunk" ["main pulmonary artery"] "45341000" "Pulmonary trunk" Some(8612);
    PAIRED "chest" "pulmonary artery" [] "81040000" "Pulmonary artery" Some(66326);
    SINGLE "chest" "brachiocephalic trunk" ["brachiocephalic artery", "innominate artery"]
        "12691009" "Innominate artery" Some(3932);
    PAIRED "neck" "common carotid artery" ["common carotid", "cca"] "32062004" "Common carotid artery" Some(3939);
    PAIRED "neck" "internal carotid artery" ["internal carotid", "ica"] "86117002" "Internal carotid artery" Some(3947);
    PAIRED "neck" "external carotid artery" ["external carotid", "eca"] "22286001" "External carotid artery" Some(10635);
    PAIRED "neck" "vertebral artery" ["vertebral", "va"] "85234005" "Vertebral artery" Some(3956);
    SINGLE "head" "basilar artery" ["basilar"] "59011009" "Basilar artery" Some(50542);
    PAIRED "head" "anterior cerebral artery" ["anterior cerebral", "aca"] "60176003" "Anterior Cerebral Artery" Some(50028);
    PAIRED "head" "middle cerebral artery" ["middle cerebral", "mca"] "17232002" "Middle Cerebral Artery" Some(50079);
    PAIRED "head" "posterior cerebral artery" ["posterior cerebral", "pca"] "70382005" "Posterior Cerebral Artery" Some(50583);
    PAIRED "chest" "subclavian artery" ["subclavian"] "36765005" "Subclavian artery" Some(3951);
    PAIRED "arm" "axillary artery" ["axillary"] "67937003" "Axillary Artery" Some(22654);
    SINGLE "abdomen" "celiac trunk" ["celiac", "celiac artery", "celiac axis", "coeliac", "coeliac artery", "coeliac trunk", "coeliac axis"]
        "57850000" "Celiac Axis" Some(14812);
    SINGLE "abdomen" "common hepatic artery" ["common hepatic", "cha"] "66559000" "Common Hepatic Artery" Some(14771);
    SINGLE "abdomen" "splenic artery" ["splenic"] "22083002" "Splenic artery" Some(14773);
    SINGLE "abdomen" "left gastric artery" ["left gastric", "lga"] "23771002" "Structure of left gastric artery (body structure)" Some(14768);
    SINGLE "abdomen" "superior mesenteric artery" ["superior mesenteric", "sma"]
        "42258001" "Superior mesenteric artery" Some(14749);
    SINGLE "abdomen" "inferior mesenteric artery" ["inferior mesenteric", "ima"]
        "33795007" "Inferior mesenteric artery" Some(14750);
    PAIRED "abdomen" "renal artery" ["renal", "ra"] "2841007" "Renal artery" Some(14751);
    PAIRED "pelvis" "common iliac artery" ["common iliac", "cia"] "73634005" "Common iliac artery" Some(14764);
    PAIRED "pelvis" "internal iliac artery" ["internal iliac", "iia", "hypogastric artery"]
        "90024005" "Internal iliac artery" Some(18808);
    PAIRED "pelvis" "external iliac artery" ["external iliac", "eia"] "113269004" "External iliac artery" Some(18805);
    PAIRED "leg" "common femoral artery" ["common femoral", "cfa"] "181347005" "Common Femoral Artery" Some(323778);
    PAIRED "leg" "superficial femoral artery" ["superficial femoral", "sfa"] "181349008" "Superficial Femoral Artery" Some(323777);
    PAIRED "leg" "deep femoral artery" ["deep femoral", "profunda femoris", "profunda femoris artery", "dfa", "pfa"]
        "31677005" "Profunda Femoris Artery" Some(20741);
    RECOGNISED_PAIRED "leg" "femoral artery" ["femoral"] "7657000" "Femoral artery" Some(70248);
    PAIRED "leg" "popliteal artery" ["popliteal"] "43899006" "Popliteal artery" Some(77155);
    PAIRED "leg" "anterior tibial artery" ["anterior tibial", "ata"] "68053000" "Anterior tibial artery" Some(43894);
    PAIRED "leg" "posterior tibial artery" ["posterior tibial", "pta"] "13363002" "Posterior tibial artery" Some(43895);
    PAIRED "leg" "fibular artery" ["fibular", "peroneal", "peroneal artery"] "8821006" "Peroneal artery" Some(43921);
    SINGLE "abdomen" "portal vein" [] "32764006" "Portal vein" Some(50735);
    SINGLE "chest" "superior vena cava" ["svc"] "48345005" "Superior vena cava" Some(4720);
    SINGLE "abdomen" "inferior vena cava" ["ivc"] "64131007" "Inferior vena cava" Some(10951);
}

#[cfg(test)]
#[path = "tests/vessel_names.rs"]
mod tests;
