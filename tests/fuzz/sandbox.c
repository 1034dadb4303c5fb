/* SPDX-License-Identifier: MIT
 *
 * sandbox - variables of every kind, a timer and a counter, and little else.
 */
#include "tests/fuzz/sandbox.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

static const char text[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  Start AT %IX0.0 : BOOL; Stop AT %IX0.1 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL; Lamp1 : BOOL; Lamp2 : BOOL;\n"
	"  Level AT %IW2 : INT; Total : DINT; Heat : REAL; Pause : TIME;\n"
	"  Bits : WORD; Runout : TON; Parts : CTU;\n"
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

void sandbox_open(struct sandbox *sandbox)
{
	const struct program *program;
	size_t size;

	memset(sandbox, 0, sizeof(*sandbox));
	sandbox->sink.write = swallow;
	sandbox->ladder = ladder_new();
	fuzz_expect(sandbox->ladder && ladder_load_text(sandbox->ladder,
		    "sandbox.rung", text, sizeof(text) - 1) &&
		    ladder_build(sandbox->ladder), "the sandbox is built");
	program = ladder_program(sandbox->ladder);
	size = (image_memory_size(program) + 7) / 8 * 8;
	sandbox->memory = aligned_alloc(8, size);
	fuzz_expect(sandbox->memory != NULL, "memory");
	resource_init(&sandbox->resource, program, sandbox->memory);
}

void sandbox_close(struct sandbox *sandbox)
{
	free(sandbox->memory);
	ladder_free(sandbox->ladder);
}
