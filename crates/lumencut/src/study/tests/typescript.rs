//! Generates the page's types, `web/src/core/generated/questions.ts`, from the table of questions. A test fails if the file is out
//! of date; `make generate` writes it again.

use std::collections::BTreeMap;
use std::fmt::Write;

use lumencut_core::named::Named;
use lumencut_vessels::measure::stenosis::Method;
use lumencut_vessels::measure::stenosis::groups::Territory;
use ts_rs::{Config, TS, TypeVisitor};

use super::generated::require_current;
use super::pretty::{comment, pretty, with_readonly};
use crate::study::asking::Turn;
use crate::study::questions::declare;
use crate::study::view::METHODS;

pub(crate) struct Types {
    config: Config,
    declared: BTreeMap<String, String>,
    questions: String,
    turns: String,
}

impl Types {
    pub(crate) fn question<M: TS + 'static, A: TS + 'static>(
        &mut self,
        name: &str,
        about: &[&str],
        turn: Turn,
    ) {
        let message = self.named::<M>();
        let answer = self.named::<A>();
        let about: Vec<&str> = about.iter().map(|line| line.trim()).collect();
        let row =
            format!("{}{name}: {{ message: {message}, answer: {answer}, }},\n", comment(&about.join("\n")));
        self.questions += &row;
        let turn = match turn {
            Turn::First => "{ when: 'first', words: null }".to_owned(),
            Turn::Long(words) => format!("{{ when: 'first', words: '{words}' }}"),
            Turn::Later => "{ when: 'later', words: null }".to_owned(),
            Turn::AtOnce => "{ when: 'at once', words: null }".to_owned(),
        };
        let _ = writeln!(self.turns, "  {name}: {turn},");
    }

    /// The name of a type, which is declared together with the types that it uses. Messages of rows are inlined.
    fn named<T: TS + 'static>(&mut self) -> String {
        self.visit::<T>();
        let name = T::name(&self.config);
        if name == ROW { T::inline(&self.config) } else { name }
    }
}

const ROW: &str = "Message";

impl TypeVisitor for Types {
    fn visit<T: TS + 'static + ?Sized>(&mut self) {
        let name = T::name(&self.config);
        if T::output_path().is_some() && name != ROW {
            if self.declared.contains_key(&name) {
                return;
            }
            let about = T::docs().unwrap_or_default();
            let declared = format!("{about}export {}\n", T::decl(&self.config));
            self.declared.insert(name, declared);
        }
        T::visit_dependencies(self);
        T::visit_generics(self);
    }
}

fn one_of(name: &str, texts: impl IntoIterator<Item = &'static str>) -> String {
    let texts: Vec<String> = texts.into_iter().map(|text| format!("'{text}'")).collect();
    format!("export type {name} = {};\n", texts.join(" | "))
}

fn written() -> String {
    let config = Config::new().with_large_int("number");
    let (questions, turns) = (String::new(), String::new());
    let mut types = Types { config, declared: BTreeMap::new(), questions, turns };
    declare(&mut types);
    let names = [
        one_of("Method", METHODS.map(|[name, _]| name)),
        one_of("StenosisMethod", Method::names()),
        one_of("Territory", Territory::names()),
    ];
    let declared: Vec<String> = types.declared.into_values().collect();
    let table = format!(
        "/** The questions that the engine answers, by their names. */\nexport type Questions = {{\n{}}};\n",
        types.questions
    );
    let all = [declared.join("\n"), table].join("\n");
    format!(
        "{HEAD}\n{}\n{}\n/** When each question is answered, and what its progress is called. */\nexport const TURNS = {{\n{}}} as const satisfies Record<keyof Questions, Turn>;\n",
        names.concat(),
        with_readonly(&pretty(&all)),
        types.turns
    )
}

const HEAD: &str = "\
/** What the engine is asked and answers, written of `crates/lumencut/src/study/questions.rs` by `make generate`; a test says where it is stale. */
import type { Bytes, Pair, Settings, SettingValue, Turn, Vector } from '../plain';
";

#[test]
fn the_types_of_the_page_are_those_of_the_table() {
    require_current("questions.ts", &written());
}
