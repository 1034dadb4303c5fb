/* SPDX-License-Identifier: MIT
 *
 * trace_form - CSV and VCD. Of use to trace.c only.
 */
#ifndef TRIAL_TRACE_FORM_H
#define TRIAL_TRACE_FORM_H

#include "engine/trial/trace.h"

/** trace_update - keeps @value as the last one; true if it differs. */
bool trace_update(struct trace_column *column, union iec_value value);

void trace_csv_head(struct trace *trace);
void trace_csv(struct trace *trace, uint64_t scan, int64_t now_ns);
void trace_vcd_head(struct trace *trace);
void trace_vcd(struct trace *trace, int64_t now_ns);
void trace_vcd_note(struct trace *trace, const char *text, size_t len);
#endif
