/* SPDX-License-Identifier: MIT
 *
 * sandbox - variables of every kind, a timer and a counter.
 */
#include "tests/fuzz/sandbox.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>

static const char text[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  Start AT %IX0.0 : BOOL; Stop AT %IX0.1 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL; Lamp1 : BOOL; Lamp2 : BOOL;\n"
	"  Level AT %IW2 : INT; Total : DINT; Heat : REAL; Pause : TIME;\n"
	"  Bits : WORD; Runout : TON; Parts : CTU;\n"
	"  Name : STRING[6]; Clock : TOD; Day : DATE; Now : DT; Exact : LREAL;\n"
	"  Big : ULINT;\n"
	"END_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n"
	"  | NO Start  | NC Stop | COIL Motor |\n"
	"  | NO Motor ^|\n"
	"RUNG\n"
	"  | NO Motor | TON Runout PT:=T#50ms | COIL Lamp1 |\n"
	"RUNG\n"
	"  | NO Start | CTU Parts PV:=3 | COIL Lamp2 |\n"
	"RUNG\n"
	"  | [ Name = 'a' ] | [ Clock > TOD#01:00:00 ] | [ Day > D#2000-01-01 ] | "
	"[ Now > DT#2000-01-01-00:00:00 ] | [ Exact > 1.0 ] | [ Big > 5 ] | COIL Q5 |\n"
	"RUNG\n"
	"  | [ Level > 100 ] | [ Total := Total + Level ] |\n"
	"END_PROGRAM\n";

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	(void)bytes;
	*out_len = len;
	return NULL;
}

static void swallow(void *context, const char *bytes, size_t len)
{
	volatile char sum = 0;

	(void)context;
	for (size_t i = 0; i < len; i++)
		sum = (char)(sum ^ bytes[i]);
}

struct sandbox *sandbox_open(void)
{
	static struct sandbox sandbox = { .sink.write = swallow };
	static struct ladder *ladder;
	static void *memory;
	size_t size;

	if (!ladder) {
		ladder = ladder_new();
		fuzz_expect(ladder && ladder_load_text(ladder, "sandbox.rung",
			    text, sizeof(text) - 1) && ladder_build(ladder),
			    "the sandbox is built");
		size = image_memory_size(ladder_program(ladder));
		memory = aligned_alloc(8, (size + 7) / 8 * 8);
		fuzz_expect(memory != NULL, "memory");
	}
	resource_init(&sandbox.resource, ladder_program(ladder), memory);
	return &sandbox;
}
