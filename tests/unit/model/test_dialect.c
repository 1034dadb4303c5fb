/* SPDX-License-Identifier: MIT
 *
 * test_dialect - what names of other tools mean here.
 */
#include "engine/model/dialect.h"
#include "tests/tap.h"

#include <stdio.h>
#include <string.h>

/* All meanings of a name, as one text; "": none. */
static const struct { const char *name, *means; } cases[] = {
	/* S7-200 and GX Works */
	{ "T37", "T37 : TON, Q" }, { "t0", "t0 : TON, Q" }, { "C0", "C0 : CTU, Q" },
	{ "T37.ET", "T37 : TON, ET" }, { "C0.CV", "C0 : CTU, CV" }, { "C0.Z", "" },
	{ "D0", "D0 AT %VW0 : INT" }, { "D10", "D10 AT %VW20 : INT" },
	{ "X5", "%IX0.5" }, { "Y7", "%QX0.7" }, { "X10", "%IX1.0 or %IX2.0" },
	{ "Y17", "%QX1.7 or %QX2.7" }, { "X18", "%IX3.0 or %IX3.0" },
	{ "E0.0", "%IX0.0" }, { "A4.1", "%QX4.1" }, { "E0", "" },
	/* Logix */
	{ "I:1/3", "%IX2.3" }, { "O:0/10", "%QX1.2" }, { "B3:1/2", "%MX2.2" }, { "I:1/16", "" },
	/* Omron */
	{ "CIO0.00", "%IX0.0" }, { "CIO1.15", "%IX3.7" }, { "cio100.09", "%QX1.1" }, { "CIO10.00", "" }, { "CIO0.16", "" },
	{ "CIO0.5", "" }, { "CIO200.00", "" }, { "W3.11", "%MX7.3" }, { "W0.5", "" }, { "W0", "" }, { "H0.01", "" },
	/* ClassicLadder */
	{ "%B3", "%MX0.3" }, { "%W5", "%VD20" }, { "%QLED1", "%XQX0.1" }, { "%SW0", "%SD64" },
	{ "%E0", "%SX32.0" }, { "%IF1", "%XAID4" },
	{ "%T0.D", "T0 : CL_TIMER, D" }, { "T0.D", "T0 : CL_TIMER, D" },
	{ "%TM1.V", "TM1 : CL_TON, V" }, { "TM1.q", "TM1 : CL_TON, Q" },
	{ "%C2.D", "C2 : CL_COUNTER, D" }, { "%M0.R", "Mono0 : CL_MONO, R" },
	{ "%R0.E", "Reg0 : CL_REGISTER, E" },
	{ "%X0.A", "step X0, ; step Step0, X; step S0, X" },
	{ "%x3.v", "step XTime3, V; step Step3, T; step S3, T" },
	{ "%T0.Z", "" }, { "%Z0", "" }, { "%T0", "" }, { "%", "" }, { "T", "" }, { "", "" },
	{ "Temp", "" }, { "T1000000", "" }, { "D", "" }, { "T1a", "" }, { "Start.Q", "" },
	{ "%T0.", "" }, { "T0.", "" }, { "D0.1", "" },
};

static void print(const struct dialect *found, char *out, size_t size)
{
	char addr[40], other[40];
	const size_t used = strlen(out);

	iec_addr_print(found->addr, addr, sizeof(addr));
	iec_addr_print(found->other, other, sizeof(other));
	out += used;
	size -= used;
	switch (found->kind) {
	case DIALECT_ADDRESS:
		snprintf(out, size, "%s", addr);
		break;
	case DIALECT_UNSURE:
		snprintf(out, size, "%s or %s", addr, other);
		break;
	case DIALECT_WORD:
		snprintf(out, size, "%s AT %s : %s", found->name, addr,
			 iec_type_row(found->type)->word);
		break;
	case DIALECT_BLOCK:
	case DIALECT_PIN:
		snprintf(out, size, "%s : %s, %s", found->name, found->word, found->pin);
		break;
	case DIALECT_STEP:
		snprintf(out, size, "%sstep %s, %s", used ? "; " : "", found->name, found->pin);
		break;
	}
}

int main(void)
{
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		const char *name = cases[i].name;
		struct dialect found;
		char means[160] = "";

		for (int k = 0; dialect_find(name, strlen(name), k, &found); k++)
			print(&found, means, sizeof(means));
		if (strcmp(means, cases[i].means))
			printf("# %s: %s\n", name, means);
		CHECK_AS(strcmp(means, cases[i].means) == 0, name);
	}
	return tap_done();
}
