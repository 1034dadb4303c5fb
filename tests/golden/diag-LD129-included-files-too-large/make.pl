# A file of 16 MB and a program that includes it four times: more than 64 MB together.
use strict;
use warnings;

sub put {
	my ($name, $text) = @_;
	open my $to, '>:raw', $name or die "$name: $!\n";
	print $to $text;
	close $to or die "$name: $!\n";
}

put('large.rung', "RUNGBOARD 1\n(*" . ' ' x (16 << 20) . "*)\n");
put('main.rung', "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\nEND_PROGRAM\n\n" .
	"INCLUDE \"large.rung\"\n" x 4);
