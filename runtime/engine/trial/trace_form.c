/* SPDX-License-Identifier: MIT
 *
 * trace_form - the trace as CSV (RFC 4180) and as VCD (IEEE 1364 clause 18),
 * for spreadsheets and wave viewers. A head names the columns once, so they
 * cannot change under way.
 */
#include "engine/trial/trace_form.h"

#include <string.h>

void trace_csv_head(struct trace *trace)
{
	sink_text(trace->out, "scan,t_ms");
	for (int i = 0; i < trace->count; i++) {
		sink_text(trace->out, ",");
		sink_text(trace->out, trace->column[i].name);
	}
	sink_text(trace->out, "\r\n");
}

/* In double quotes where a spreadsheet would see two fields. */
static void csv_field(struct trace *trace, const char *text)
{
	bool quoted = strpbrk(text, ",\"") != NULL;

	if (quoted)
		sink_text(trace->out, "\"");
	for (; *text; text++)
		sink_write(trace->out, *text == '"' ? "\"\"" : text,
			   *text == '"' ? 2 : 1);
	if (quoted)
		sink_text(trace->out, "\"");
}

void trace_csv(struct trace *trace, uint64_t scan, int64_t now_ns)
{
	union iec_value time = { .i = now_ns };
	char text[IEC_VALUE_TEXT];
	bool changed = false;

	if (!trace->begun)
		trace_csv_head(trace);
	for (int i = 0; i < trace->count; i++) {
		struct trace_column *column = &trace->column[i];

		changed |= trace_update(column,
					image_get(column->image, column->at));
	}
	if (trace->changes && !changed)
		return;
	iec_value_print(IEC_TIME, time, text, sizeof(text));
	sink_printf(trace->out, "%llu,%s", (unsigned long long)scan, text);
	for (int i = 0; i < trace->count && !trace_stopped(trace); i++) {
		const struct trace_column *column = &trace->column[i];

		iec_value_print(column->at.type, column->last, text,
				sizeof(text));
		sink_text(trace->out, ",");
		csv_field(trace, text);
	}
	sink_text(trace->out, "\r\n");
}

/* The identifier of a column: a number to the base 94, in printables. */
static void vcd_id(int column, char out[8])
{
	int n = 0;

	do {
		out[n++] = (char)('!' + column % 94);
		column /= 94;
	} while (column && n < 7);
	out[n] = '\0';
}

static int vcd_width(enum iec_type type)
{
	return type == IEC_BOOL ? 1 : iec_type_row(type)->size * 8;
}

static bool is_real(enum iec_type type)
{
	return iec_type_row(type)->class == CLASS_REAL;
}

/* IEEE 1364 has no texts; viewers take s and bytes, odd ones as \\ooo. */
static void vcd_text(struct trace *trace, const struct iec_string *s)
{
	sink_text(trace->out, "s");
	for (int i = 0; i < s->length; i++) {
		unsigned char c = (unsigned char)s->text[i];

		if (c > ' ' && c < 0x7f && c != '\\')
			sink_write(trace->out, &s->text[i], 1);
		else
			sink_printf(trace->out, "\\%03o", c);
	}
}

static void vcd_value(struct trace *trace, int i)
{
	const struct trace_column *column = &trace->column[i];
	char id[8], text[80];
	int width = vcd_width(column->at.type), n = 0;
	uint64_t bits = (uint64_t)column->last.i;

	vcd_id(i, id);
	if (column->at.type == IEC_STRING) {
		vcd_text(trace, column->last.s);
		sink_printf(trace->out, " %s\n", id);
		return;
	}
	if (is_real(column->at.type)) {
		sink_printf(trace->out, "r%.*g %s\n",
			    column->at.type == IEC_REAL ? 9 : 17,
			    column->last.r, id);
		return;
	}
	if (width == 1) {
		sink_printf(trace->out, "%d%s\n", bits != 0, id);
		return;
	}
	while (width-- > 0)
		text[n++] = (char)('0' + (bits >> width & 1));
	text[n] = '\0';
	sink_printf(trace->out, "b%s %s\n", text, id);
}

void trace_vcd_head(struct trace *trace)
{
	char id[8];

	sink_text(trace->out, "$version Rungboard $end\n$timescale 1ns $end\n"
			      "$scope module program $end\n");
	for (int i = 0; i < trace->count; i++) {
		const struct trace_column *column = &trace->column[i];
		bool real = is_real(column->at.type);
		bool text_column = column->at.type == IEC_STRING;

		vcd_id(i, id);
		sink_printf(trace->out, "$var %s %d %s ", text_column ? "string" :
			    real ? "real" : "wire", text_column ? 1 :
			    real ? 64 : vcd_width(column->at.type), id);
		sink_text(trace->out, column->name);
		sink_text(trace->out, " $end\n");
	}
	sink_text(trace->out, "$upscope $end\n$enddefinitions $end\n#0\n"
			      "$dumpvars\n");
	for (int i = 0; i < trace->count; i++)
		vcd_value(trace, i);
	sink_text(trace->out, "$end\n");
	trace->stamp_ns = 0;
}

void trace_vcd(struct trace *trace, int64_t now_ns)
{
	if (!trace->begun)
		trace_vcd_head(trace);
	trace->last_ns = now_ns;
	for (int i = 0; i < trace->count && !trace_stopped(trace); i++) {
		struct trace_column *column = &trace->column[i];

		if (!trace_update(column, image_get(column->image, column->at)))
			continue;
		if (trace->stamp_ns != now_ns)
			sink_printf(trace->out, "#%lld\n", (long long)now_ns);
		trace->stamp_ns = now_ns;
		vcd_value(trace, i);
	}
}

void trace_vcd_note(struct trace *trace, const char *text, size_t len)
{
	if (!trace->begun || memchr(text, '$', len))
		return; /* before the head, or it would end the comment */
	sink_text(trace->out, "$comment ");
	sink_write(trace->out, text, len);
	sink_text(trace->out, " $end\n");
}
