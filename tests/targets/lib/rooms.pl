#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# rooms - prints the size of each room in a program: rooms.pl MAP-OF-THE-LINKER
#
# Adds up the sections of the program by the folder of their objects.
use strict;
use warnings;

my (%bytes, $kept, $name);
while (<>) {
	$kept = 1 if /^Linker script and memory map/;
	next unless $kept;
	# A long section name has its numbers on the next line.
	if (/^ (\.\S+)$/) { $name = $1; next }
	if (/^ (\.\S+)?\s+0x[0-9a-f]+\s+0x([0-9a-f]+)\s+(\S+)$/) {
		my ($section, $size, $from) = ($1 // $name // '', hex $2, $3);
		undef $name;
		next unless $section =~ /^\.(?:text|rodata|data|ARM|got|init)/;
		my $room = $from =~ m{(?:^|/)(?:runtime/)?(engine/\w+|engine|ladderd|online|hal)/[^/]*\.o$} ? $1
			 : $from =~ m{libladder\.a\((\w+)\.o\)} ? room_of($1)
			 : $from =~ m{/lib(c|gcc|gcc_eh|m)\.a} ? "C library"
			 : "other";
		$bytes{$room} += $size;
	}
	last if /^OUTPUT\(/;
}
printf "  %-18s %7d\n", $_, $bytes{$_} for sort { $bytes{$b} <=> $bytes{$a} } keys %bytes;

# An archive has no folders: finds the source with this name.
sub room_of {
	my ($object) = @_;
	my ($source) = (glob("runtime/engine/*/$object.c"), glob("runtime/engine/$object.c"));
	return defined $source && $source =~ m{^runtime/(.*)/} ? $1 : 'other';
}
