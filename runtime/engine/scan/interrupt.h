/* SPDX-License-Identifier: MIT
 *
 * interrupt - what a task keeps of its own while a task of higher priority runs.
 *
 * Tasks share all variables. But the inputs of a task stay those that were read when it began,
 * and its outputs are seen by others only when it has ended. So at an interruption the inputs
 * and outputs of the interrupted task are set aside, in memory behind the data of the program.
 */
#ifndef SCAN_INTERRUPT_H
#define SCAN_INTERRUPT_H

#include "engine/scan/image.h"

/** interrupt_can - whether a task of higher priority can become due while @task runs.
 * Scan-safe: yes. */
bool interrupt_can(const struct program *program, uint32_t task);
/** interrupt_levels - how many tasks can be interrupted at the same time, LIMIT_LEVELS at most;
 * 0: no task interrupts another. Scan-safe: yes. */
uint32_t interrupt_levels(const struct program *program);
/** interrupt_bytes - memory for interrupt_levels(), as a part of image_memory_size(). Scan-safe:
 * yes. */
size_t interrupt_bytes(const struct program *program);
/** interrupt_written - the outputs in the image are those of whole tasks. At the start of a
 * scan of a program with interrupt_levels(). Scan-safe: yes; a copy of the outputs. */
void interrupt_written(struct image *image);
/** interrupt_keep_inputs, interrupt_give_inputs - keeps the inputs from outside while a scan goes
 * on that stood, and gives them back. Scan-safe: yes; a copy of the inputs. */
void interrupt_keep_inputs(struct image *image);
void interrupt_give_inputs(struct image *image);
/** interrupt_begin - sets inputs and outputs aside; the outputs in the image become those of
 * whole tasks. @level: 0 for the first task that is interrupted, below interrupt_levels().
 * Scan-safe: yes; copies of inputs and outputs. */
void interrupt_begin(struct image *image, uint32_t level);
/** interrupt_end - the other end: outputs that were changed since keep their new values, the
 * other ones become those of the interrupted task again. Scan-safe: likewise. */
void interrupt_end(struct image *image, uint32_t level);
#endif
