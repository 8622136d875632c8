//! The open device: submitting, waiting, copying, and what went wrong, as errors instead of panics.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use wgpu::{Buffer, BufferUsages};

/// First thing that went wrong on the device.
type Trouble = Arc<Mutex<Option<String>>>;

/// How long to wait before looking whether the device is still there.
const PATIENCE: Duration = Duration::from_secs(1);
/// Bytes copied at once: bounds the memory that copies take beside the tables.
const PIECE: u64 = 64 << 20;

pub struct Connection {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    trouble: Trouble,
}

fn keep(trouble: &Trouble, reason: String) {
    if let Ok(mut slot) = trouble.lock() {
        slot.get_or_insert(reason);
    }
}

impl Connection {
    /// Opens the device with all of the adapter's limits and the features wanted that it has.
    pub fn open(adapter: &wgpu::Adapter, features: wgpu::Features) -> Result<Self, String> {
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("lithosph"),
            required_features: features & adapter.features(),
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| format!("cannot open {}: {error}", adapter.get_info().name))?;
        let trouble = Trouble::default();
        let slot = trouble.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| keep(&slot, error.to_string())));
        let slot = trouble.clone();
        device.set_device_lost_callback(move |reason, message| {
            keep(&slot, format!("the graphics device was lost ({reason:?}): {message}"));
        });
        Ok(Self { device, queue, trouble })
    }

    /// The first error that the device has reported.
    pub fn check(&self) -> Result<(), String> {
        match self.trouble.lock().map(|slot| slot.clone()) {
            Ok(None) => Ok(()),
            Ok(Some(reason)) => Err(reason),
            Err(_) => Err("an error of the graphics device could not be recorded".into()),
        }
    }

    /// Waits for all that was submitted.
    pub fn wait(&self) -> Result<(), String> {
        loop {
            let poll = || self.device.poll(wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) });
            // wgpu panics if the device is lost while it polls.
            let polled = catch_unwind(AssertUnwindSafe(poll));
            self.check()?;
            match polled {
                Ok(Ok(_)) => return Ok(()),
                Ok(Err(wgpu::PollError::Timeout)) => {}
                Ok(Err(error)) => return Err(format!("waiting for the graphics device: {error}")),
                Err(_) => return Err("the graphics device was lost".into()),
            }
        }
    }

    pub fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    pub fn submit(&self, encoder: wgpu::CommandEncoder) -> Result<(), String> {
        self.queue.submit([encoder.finish()]);
        self.check()
    }

    /// A table: zeros until written.
    pub fn table(&self, name: &str, bytes: u64) -> Result<Buffer, String> {
        self.buffer(name, bytes, BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST)
    }

    pub fn buffer(&self, name: &str, bytes: u64, usage: BufferUsages) -> Result<Buffer, String> {
        let descriptor = wgpu::BufferDescriptor { label: Some(name), size: bytes, usage, mapped_at_creation: false };
        let buffer = self.device.create_buffer(&descriptor);
        self.check().map_err(|error| format!("cannot allocate {bytes} bytes for {name} on the device: {error}"))?;
        Ok(buffer)
    }

    /// Writes in pieces, so that the copy on the way takes little memory.
    pub fn write(&self, buffer: &Buffer, bytes: &[u8]) -> Result<(), String> {
        for (k, piece) in bytes.chunks(PIECE as usize).enumerate() {
            self.queue.write_buffer(buffer, k as u64 * PIECE, piece);
            if bytes.len() as u64 > PIECE {
                self.queue.submit([]);
                self.wait()?;
            }
        }
        self.check()
    }

    /// Reads the first bytes of each buffer, waiting for all that was submitted.
    pub fn read(&self, wanted: &[(&Buffer, u64)]) -> Result<Vec<Vec<u8>>, String> {
        let total: u64 = wanted.iter().map(|(_, bytes)| bytes).sum();
        let mut out: Vec<Vec<u8>> = wanted.iter().map(|(_, bytes)| Vec::with_capacity(*bytes as usize)).collect();
        if total == 0 {
            return Ok(out);
        }
        let staging = self.buffer("staging", total.min(PIECE), BufferUsages::MAP_READ | BufferUsages::COPY_DST)?;
        let mut batch: Vec<(usize, u64)> = Vec::new();
        let (mut encoder, mut used) = (self.encoder(), 0);
        for (k, &(buffer, bytes)) in wanted.iter().enumerate() {
            let mut begin = 0;
            while begin < bytes {
                let length = (bytes - begin).min(PIECE - used);
                encoder.copy_buffer_to_buffer(buffer, begin, &staging, used, length);
                batch.push((k, length));
                (begin, used) = (begin + length, used + length);
                if used == PIECE {
                    self.submit(std::mem::replace(&mut encoder, self.encoder()))?;
                    self.drain(&staging, &mut batch, &mut out)?;
                    used = 0;
                }
            }
        }
        self.submit(encoder)?;
        self.drain(&staging, &mut batch, &mut out)?;
        Ok(out)
    }

    /// Appends the pieces that lie in the staging buffer to their owners.
    fn drain(&self, staging: &Buffer, batch: &mut Vec<(usize, u64)>, out: &mut [Vec<u8>]) -> Result<(), String> {
        let total = batch.iter().map(|(_, length)| length).sum();
        if total == 0 {
            return Ok(());
        }
        self.map(staging, total, |bytes| {
            let mut begin = 0;
            for (k, length) in batch.drain(..) {
                let end = begin + length as usize;
                out[k].extend_from_slice(&bytes[begin..end]);
                begin = end;
            }
        })
    }

    /// Waits for the buffer's contents and looks at them.
    pub fn map<T>(&self, staging: &Buffer, bytes: u64, look: impl FnOnce(&[u8]) -> T) -> Result<T, String> {
        let slot = self.trouble.clone();
        staging.map_async(wgpu::MapMode::Read, 0..bytes, move |result| {
            if let Err(error) = result {
                keep(&slot, format!("cannot read from the graphics device: {error}"));
            }
        });
        self.wait()?;
        let view =
            staging.get_mapped_range(0..bytes).map_err(|error| format!("cannot read from the graphics device: {error}"))?;
        let out = look(&view);
        drop(view);
        staging.unmap();
        Ok(out)
    }
}
