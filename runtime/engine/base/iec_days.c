/* SPDX-License-Identifier: MIT
 *
 * iec_days - the Gregorian calendar as numbers. No time zones, no leap seconds, no
 * clock.
 */
#include "engine/base/iec.h"

/* Year, month and day of a day since 1970-01-01 in the Gregorian calendar: 400 years
 * have 146097 days. Counting years from March puts the leap day last. */
void iec_civil(int64_t day, int *year, int *month, int *day_of_month)
{
	int64_t shifted = day + 719468; /* from 0000-03-01 */
	int64_t era = (shifted >= 0 ? shifted : shifted - 146096) / 146097;
	int64_t of_era = shifted - era * 146097;
	int64_t year_of_era = (of_era - of_era / 1460 + of_era / 36524 -
			       of_era / 146096) / 365;
	int64_t of_year = of_era - (365 * year_of_era + year_of_era / 4 -
				    year_of_era / 100);
	int64_t from_march = (5 * of_year + 2) / 153;

	*day_of_month = (int)(of_year - (153 * from_march + 2) / 5 + 1);
	*month = (int)(from_march < 10 ? from_march + 3 : from_march - 9);
	*year = (int)(year_of_era + era * 400 + (*month <= 2));
}

int64_t iec_days(int year, int month, int day_of_month)
{
	int64_t y = year - (month <= 2);
	int64_t era = (y >= 0 ? y : y - 399) / 400;
	int64_t year_of_era = y - era * 400;
	int64_t of_year = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 +
			  day_of_month - 1;
	int64_t of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 +
			 of_year;

	return era * 146097 + of_era - 719468;
}

bool iec_date(int64_t year, int64_t month, int64_t day_of_month, int64_t *ns)
{
	int y, m, d;
	int64_t days;

	if (year < 0 || year > 9999 || month < 1 || month > 12 || day_of_month < 1 ||
	    day_of_month > 31)
		return false;
	days = iec_days((int)year, (int)month, (int)day_of_month);
	iec_civil(days, &y, &m, &d);
	return d == day_of_month &&
	       !__builtin_mul_overflow(days, INT64_C(86400000000000), ns);
}
