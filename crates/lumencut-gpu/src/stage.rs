//! A stage of the pipeline on the GPU: its compiled shader, assembled from modules and their imports.

use crate::device::Device;
use lumencut_core::shaders::{SHADERS, Shader};
use wgpu::{BindGroup, BindGroupEntry, BindingResource, ComputePipeline};

/// An entry point of a module, compiled; labels and timings use the module's name.
#[derive(Debug)]
pub(crate) struct Stage {
    pub name: &'static str,
    pub pipeline: ComputePipeline,
    first_binding: u32,
}

impl Stage {
    /// Compiles the module `room`, such as `stages/depth`, with its overrides set to `constants`.
    pub(crate) fn new(device: &Device, room: &'static str, constants: &[(&str, f64)]) -> Self {
        Self::entry(device, room, name_of(room), constants)
    }

    /// Another entry point of `room`; it counts as a part of the same stage.
    pub(crate) fn entry(device: &Device, room: &'static str, entry: &str, constants: &[(&str, f64)]) -> Self {
        let name = name_of(room);
        let source = wgpu::ShaderSource::Wgsl(assemble(room).into());
        let descriptor = wgpu::ShaderModuleDescriptor { label: Some(name), source };
        let module = device.device.create_shader_module(descriptor);
        let options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
        let pipeline = device.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: None,
            module: &module,
            entry_point: Some(entry),
            compilation_options: options,
            cache: None,
        });
        Self { name, pipeline, first_binding: 0 }
    }

    /// The same stage for an entry point that does not use the bindings before `first_binding`.
    pub(crate) fn with_first_binding(mut self, first_binding: u32) -> Self {
        self.first_binding = first_binding;
        self
    }

    pub(crate) fn bind(&self, device: &Device, resources: &[BindingResource]) -> BindGroup {
        let entries: Vec<_> = (self.first_binding..)
            .zip(resources)
            .map(|(binding, resource)| BindGroupEntry { binding, resource: resource.clone() })
            .collect();
        device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.name),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        })
    }
}

fn name_of(room: &str) -> &str {
    room.rsplit('/').next().unwrap_or(room)
}

const IMPORT: &str = "// import ";

/// The WGSL of the module `room`, preceded by that of all modules it imports, each once.
///
/// # Panics
/// For a module without a shader; a test assembles all of them.
pub fn assemble(room: &str) -> String {
    assemble_from(SHADERS, room)
}

pub(crate) fn assemble_from(shaders: &[Shader], room: &str) -> String {
    let mut done = Vec::new();
    let mut text = String::new();
    append(shaders, room, &mut done, &mut text);
    text
}

fn append(shaders: &[Shader], room: &str, done: &mut Vec<String>, text: &mut String) {
    if done.iter().any(|other| other == room) {
        return;
    }
    done.push(room.to_owned());
    let Some(shader) = shaders.iter().find(|shader| shader.room == room) else {
        panic!("no shader for the room {room}");
    };
    for import in shader.text.lines().filter_map(|line| line.strip_prefix(IMPORT)) {
        append(shaders, import.trim(), done, text);
    }
    text.push_str(shader.text);
    text.push('\n');
}
