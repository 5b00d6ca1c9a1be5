//! Settings as users choose them, one by one and in any order, and the checked settings that result.

use super::context::{Context, ContextMode, ContextName};
use super::table::{ContextChoices, Settings};
use super::value::{Transfer, Value};
use crate::error::{Error, ErrorKind, Result};
use crate::named::Named;

/// The values that a user chose; all other settings have their defaults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Choices {
    settings: Settings,
    context: ContextChoices,
}

impl Choices {
    /// Fails with [`ErrorKind::Settings`] for an unknown setting, a wrong kind of value, or an invalid name.
    pub fn set(&mut self, name: &str, value: Value) -> Result<()> {
        if ContextChoices::ROWS.iter().any(|setting| setting.name == name) {
            self.context.set(name, value)
        } else {
            self.settings.set(name, value)
        }
    }

    /// The checked settings. Fails with [`ErrorKind::Settings`] naming the first setting outside its range.
    pub fn settings(&self) -> Result<Settings> {
        // Checks the context even if it is not wanted, so that errors in it appear at once.
        self.context.check_gamma()?;
        self.context.check_step()?;
        self.settings.check_rows()?;
        self.settings.check_together()?;
        self.context.check_rows()?;
        let context = self.context.context.is_some().then(|| self.context.context());
        Ok(Settings { context, ..self.settings.clone() })
    }
}

impl Settings {
    /// Checks all settings. Fails with [`ErrorKind::Settings`] naming the first one outside its range.
    pub fn check(&self) -> Result<()> {
        self.check_rows()?;
        self.check_together()?;
        self.context.as_ref().map_or(Ok(()), |context| {
            let choices = ContextChoices::from(context);
            choices.check_rows()?;
            choices.check_step()
        })
    }
}

impl ContextChoices {
    /// The context; if none is wanted, the one with the default name.
    pub fn context(&self) -> Context {
        let name = self.context.unwrap_or(ContextName::Mida);
        let transfer = self.context_transfer.clone().unwrap_or(Transfer::Preset(name.default_transfer()));
        let mode = name.mode(self.context_gamma);
        Context {
            mode,
            window: self.context_window,
            transfer: transfer.within(self.context_window),
            step: self.context_step,
            shading: self.context_shading,
            from: self.context_from.unwrap_or(mode.default_from()),
            strength: self.context_strength,
            halo: self.context_halo,
            body: self.context_body,
            preview: self.context_preview,
        }
    }

    fn check_gamma(&self) -> Result<()> {
        let gamma = self.context_gamma;
        if gamma == 0.0 || self.context == Some(ContextName::Mida) {
            return Ok(());
        }
        let context = self.context.map_or("None".to_owned(), |context| format!("'{}'", context.name()));
        let found = format!("{gamma} with the context {context}");
        let expected =
            format!("0, or the context '{}', the only one that has a gamma", ContextName::Mida.name());
        Err(Error::new(ErrorKind::Settings, "context_gamma", found, expected))
    }

    fn check_step(&self) -> Result<()> {
        let (Some(step), Some(name)) = (self.context_step, self.context) else { return Ok(()) };
        if name.mode(self.context_gamma).is_sampled() {
            return Ok(());
        }
        let found = format!("{step} mm with the context '{}'", name.name());
        let expected = "no step: this context has exact values along rays";
        Err(Error::new(ErrorKind::Settings, "context_step", found, expected))
    }
}

impl From<&Context> for ContextChoices {
    /// The choices that lead to `context`: a blend is chosen by its γ, a transfer function by its points.
    fn from(context: &Context) -> Self {
        let (name, gamma) = match context.mode {
            ContextMode::Blend { gamma } => (ContextName::Mida, gamma),
            ContextMode::Minimum => (ContextName::Minip, 0.0),
            ContextMode::Average => (ContextName::Average, 0.0),
        };
        Self {
            context: Some(name),
            context_gamma: gamma,
            context_window: context.window,
            context_transfer: Some(Transfer::Function(context.transfer.clone())),
            context_step: context.step,
            context_shading: context.shading,
            context_from: Some(context.from),
            context_strength: context.strength,
            context_halo: context.halo,
            context_body: context.body,
            context_preview: context.preview,
        }
    }
}

impl Default for Context {
    fn default() -> Self {
        ContextChoices::default().context()
    }
}
