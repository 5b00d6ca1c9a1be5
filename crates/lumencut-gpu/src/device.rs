//! A GPU that is ready to compute, and its errors.

use std::sync::{Arc, Mutex, PoisonError};

use futures_channel::oneshot::{Sender, channel};
use lumencut_core::error::{Error, ErrorKind, Mend, Result};
use wgpu::{Adapter, Features, Limits};

use crate::adapter::{Choice, Description, choose};

/// The default limits, which every browser and driver supports.
const NEEDED: Limits = Limits::defaults();

/// A GPU that is ready to compute.
#[derive(Debug)]
pub struct Device {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) limits: Limits,
    pub(crate) has_timestamps: bool,
    description: Description,
    trouble: Arc<Mutex<Trouble>>,
}

/// Problems that the driver reported between calls.
#[derive(Debug, Default)]
struct Trouble {
    /// The first error since the last check.
    error: Option<String>,
    /// The reason, if the device is lost for good.
    loss: Option<String>,
    /// Senders to those who wait for a loss; dropping a sender wakes its receiver.
    waiting: Vec<Sender<()>>,
}

impl Device {
    /// Opens a GPU. Fails with [`ErrorKind::Device`] if there is none, or its limits are too small.
    pub async fn open(choice: Choice) -> Result<Self> {
        Self::on(&choose(choice).await?).await
    }

    pub(crate) async fn on(adapter: &Adapter) -> Result<Self> {
        let description = Description::of(adapter);
        check_limits(&description.name, &adapter.limits())?;
        let has_timestamps = adapter.features().contains(Features::TIMESTAMP_QUERY);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("lumencut"),
            required_features: if has_timestamps { Features::TIMESTAMP_QUERY } else { Features::empty() },
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let opened = adapter.request_device(&descriptor).await;
        let (device, queue) = opened.map_err(|error| broken(&description.name, &error.to_string()))?;
        let trouble = Arc::default();
        watch(&device, &trouble);
        Ok(Self { limits: device.limits(), device, queue, has_timestamps, description, trouble })
    }

    /// The driver's description of the GPU.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Fails if an error occurred since the last call or the device is lost: [`ErrorKind::Device`] with the
    /// driver's message.
    pub fn check(&self) -> Result<()> {
        let mut trouble = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        let words = trouble.loss.clone().or_else(|| trouble.error.take());
        words.map_or(Ok(()), |words| Err(broken(&self.description.name, &words)))
    }

    /// Whether the driver has reported a loss.
    pub fn is_lost(&self) -> bool {
        self.trouble.lock().unwrap_or_else(PoisonError::into_inner).loss.is_some()
    }

    /// Completes once the device is lost or dropped.
    pub fn loss(&self) -> impl Future<Output = ()> + use<> {
        let (waiting, lost) = channel();
        let mut trouble = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        if trouble.loss.is_none() {
            trouble.waiting.push(waiting);
        }
        async move {
            let _ = lost.await;
        }
    }

    pub(crate) fn unfinished(&self) -> Error {
        self.check().err().unwrap_or_else(|| broken(&self.description.name, "no result"))
    }

    /// The error for something larger than the GPU allows.
    pub(crate) fn too_large(&self, subject: &str, found: String, limit: &str) -> Error {
        let expected = format!("at most {limit} on {}", self.description.name);
        Error::new(ErrorKind::Device, subject, found, expected).mended_by(Mend::Cpu)
    }

    /// Simulates the loss of the GPU, for tests.
    pub fn lose(&self) {
        self.device.destroy();
    }
}

/// Collects the problems that the driver reports between calls.
fn watch(device: &wgpu::Device, trouble: &Arc<Mutex<Trouble>>) {
    let (on_error, on_loss) = (Arc::clone(trouble), Arc::clone(trouble));
    device.on_uncaptured_error(Arc::new(move |error| {
        let mut trouble = on_error.lock().unwrap_or_else(PoisonError::into_inner);
        trouble.error.get_or_insert_with(|| error.to_string());
    }));
    device.set_device_lost_callback(move |reason, words| {
        let mut trouble = on_loss.lock().unwrap_or_else(PoisonError::into_inner);
        trouble.loss = Some(format!("device lost ({reason:?}) {words}"));
        trouble.waiting.clear();
    });
}

fn broken(name: &str, words: &str) -> Error {
    let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
    Error::new(ErrorKind::Device, format!("GPU {name}"), words, "a GPU that completes its work")
        .mend("try a smaller picture or volume")
        .mended_by(Mend::Cpu)
}

fn check_limits(name: &str, limits: &Limits) -> Result<()> {
    let mut short = Ok(());
    NEEDED.check_limits_with_fail_fn(limits, true, |limit, needed, found| {
        let subject = format!("limit {limit} of the GPU {name}");
        short = Err(Error::new(ErrorKind::Device, subject, found.to_string(), format!("at least {needed}"))
            .mended_by(Mend::Cpu));
    });
    short
}
