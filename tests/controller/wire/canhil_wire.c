// SPDX-License-Identifier: MIT OR GPL-2.0
// Gives the emulated SJA1000 controllers a wire that can have faults. QEMU's controllers send without delay, at any bit rate, even without a receiver,
// and never have errors. This kernel module sits between the controllers and their driver (kvaser_pci, sja1000), at the two functions by which the
// driver reads and writes registers. The module shows the driver the registers of a controller with errors. The driver, the CAN code of the kernel and
// all programs are real.
//
// The wire of each controller has a state.
// Two controllers with different bit timings disturb each other. If one controller is down or bus-off, the other one has the state `alone` (see below).
// The other states are set by writing to /sys/module/canhil_wire/parameters/wire. Load the module while the controllers are down: the module reads their
// bit timings when the controllers are set up.
//   echo can1 sound              QEMU's behaviour
//   echo can1 held               can1 sends nothing until its state is sound again, as if other nodes occupied the bus
//   echo can1 slow US            each frame takes US microseconds
//   echo can1 broken             each frame ends with an error until the controller is bus-off
//   echo can1 alone              nobody acknowledges frames: can1 becomes error passive and repeats its frame endlessly
//   echo can1 raise IR SR ECC ALC TXERR RXERR    can1 raises one interrupt with these register values (hex)
#include <linux/can/dev.h>
#include <linux/hrtimer.h>
#include <linux/interrupt.h>
#include <linux/kprobes.h>
#include <linux/module.h>
#include <linux/netdevice.h>

MODULE_LICENSE("Dual MIT/GPL");
MODULE_DESCRIPTION("A wire that can fail, for emulated SJA1000 controllers");

// Registers and bits of the SJA1000 in PeliCAN mode, from its data sheet.
enum { MOD = 0, CMR = 1, SR = 2, IR = 3, IER = 4, BTR0 = 6, BTR1 = 7, ALC = 11, ECC = 12, RXERR = 14, TXERR = 15, REGS = 32 };
enum { MOD_RESET = 0x01, CMR_TRANSMIT = 0x01, CMR_ABORT = 0x02, CMR_SELF_RECEPTION = 0x10 };
enum { IR_WARNING = 0x04, IR_PASSIVE = 0x20, IR_ARBITRATION = 0x40, IR_BUS_ERROR = 0x80 };
enum { SR_TX_BUFFER_FREE = 0x04, SR_WARNING = 0x40, SR_BUS_OFF = 0x80 };
enum { ECC_FORM_ERROR_IN_DATA = 0x4a, ECC_NO_ACKNOWLEDGE = 0xd9, ECC_RECEIVED_STUFF_ERROR = 0xaa };

irqreturn_t sja1000_interrupt(int irq, void *dev_id); // exported by sja1000

enum wire { SOUND, HELD, SLOW, BROKEN, ALONE };
static const char *const names[] = {"sound", "held", "slow", "broken", "alone"};

struct controller {
	struct net_device *dev;
	const void *priv;
	enum wire wire;
	u32 frame_us;
	u8 written[REGS]; // the last value that the driver wrote to each register
	u8 seen[REGS];    // simulated values that the driver reads; in SR and IR, combined with the chip's value by OR
	u8 request;       // CMR bits of a transmission that waits
	struct hrtimer timer;
};
static struct controller controllers[2];
static struct kprobe on_write;
static bool passing; // true while this module itself writes a register

static const u64 step_ns = 1000000; // interval between the stages of a fault

static struct controller *controller_of(const void *priv)
{
	struct net_device *dev = ((const struct can_priv *)priv)->dev; // can_priv is the first member of the driver's own struct
	int i;

	for (i = 0; i < 2; ++i)
		if (controllers[i].priv == priv)
			return &controllers[i];
	for (i = 0; dev && i < 2; ++i) {
		char name[] = {'c', 'a', 'n', (char)('0' + i), 0};

		if (!strcmp(dev->name, name)) {
			controllers[i].dev = dev;
			controllers[i].priv = priv;
			return &controllers[i];
		}
	}
	return NULL;
}

static bool rates_differ(void)
{
	const u8 *a = controllers[0].written, *b = controllers[1].written;

	return controllers[0].priv && controllers[1].priv && (a[BTR0] != b[BTR0] || a[BTR1] != b[BTR1]);
}

static enum wire wire_of(const struct controller *c)
{
	const struct controller *other = &controllers[c == &controllers[0]];

	if (c->wire == ALONE || c->wire == BROKEN || !other->priv)
		return c->wire;
	if (!netif_running(other->dev) || ((const struct can_priv *)other->priv)->state == CAN_STATE_BUS_OFF)
		return ALONE;
	return rates_differ() ? BROKEN : c->wire;
}

static void interrupt(struct controller *c)
{
	unsigned long flags;

	local_irq_save(flags);
	sja1000_interrupt(c->dev->irq, c->dev);
	local_irq_restore(flags);
}

static void raise(struct controller *c, u8 ir, u8 sr, u8 ecc, u8 alc, u8 txerr, u8 rxerr)
{
	c->seen[IR] = ir & c->written[IER];
	c->seen[SR] = sr;
	c->seen[ECC] = ecc;
	c->seen[ALC] = alc;
	c->seen[TXERR] = txerr;
	c->seen[RXERR] = rxerr;
	interrupt(c);
}

static void write_chip(struct controller *c, int reg, u8 value)
{
	passing = true;
	((void (*)(const void *, int, u8))on_write.addr)(c->priv, reg, value);
	passing = false;
}

// The receiver of a frame with another bit rate counts errors too, but a receiver never becomes bus-off.
static void disturb(struct controller *c, u8 ir, u8 rxerr)
{
	if (netif_running(c->dev) && !c->seen[TXERR] && c->seen[RXERR] < rxerr)
		raise(c, ir | IR_BUS_ERROR, SR_WARNING, ECC_RECEIVED_STUFF_ERROR, 0, 0, rxerr);
}

static void transmit(struct controller *c)
{
	u8 request = c->request;

	c->request = 0;
	if (c->seen[TXERR] || c->seen[RXERR])
		raise(c, IR_WARNING, 0, 0, 0, 0, 0); // error-active again
	write_chip(c, CMR, request);
}

static enum hrtimer_restart next_stage(struct hrtimer *timer)
{
	struct controller *c = container_of(timer, struct controller, timer);
	enum wire wire = wire_of(c);
	u8 ecc = wire == ALONE ? ECC_NO_ACKNOWLEDGE : ECC_FORM_ERROR_IN_DATA;

	// If the timer interrupts a probe, the kernel does not call the probes of the driver's interrupt routine. Then the driver
	// has not read the register, and the interrupt must be repeated.
	if (c->seen[IR]) {
		interrupt(c);
		hrtimer_forward_now(timer, ns_to_ktime(step_ns));
		return c->seen[IR] || c->request ? HRTIMER_RESTART : HRTIMER_NORESTART;
	}
	if (!c->request || wire == HELD)
		return HRTIMER_NORESTART;
	if (wire != BROKEN && wire != ALONE) {
		transmit(c);
		return HRTIMER_NORESTART;
	}
	hrtimer_forward_now(timer, ns_to_ktime(step_ns));
	if (c->seen[TXERR] < 96) {
		raise(c, IR_WARNING | IR_BUS_ERROR, SR_WARNING, ecc, 0, 96, 0);
		if (rates_differ())
			disturb(&controllers[c == &controllers[0]], IR_WARNING, 96);
	} else if (c->seen[TXERR] < 128) {
		raise(c, IR_PASSIVE | IR_BUS_ERROR, SR_WARNING, ecc, 0, 128, 0);
		if (rates_differ())
			disturb(&controllers[c == &controllers[0]], IR_PASSIVE, 128);
	} else if (wire == BROKEN) {
		c->request = 0;
		write_chip(c, MOD, MOD_RESET); // the chip also enters reset mode when it becomes bus-off
		raise(c, IR_WARNING | IR_BUS_ERROR, SR_WARNING | SR_BUS_OFF, ecc, 0, 255, 0);
		return c->seen[IR] ? HRTIMER_RESTART : HRTIMER_NORESTART;
	}
	return HRTIMER_RESTART;
}

static int before_write(struct kprobe *probe, struct pt_regs *regs)
{
	struct controller *c = controller_of((const void *)regs->di);
	unsigned int reg = (unsigned int)regs->si;
	u8 value = (u8)regs->dx;

	if (!c || reg >= REGS || passing)
		return 0;
	c->written[reg] = value;
	if (reg == MOD && (value & MOD_RESET)) {
		c->request = 0;
		memset(c->seen, 0, sizeof(c->seen));
	} else if (reg == TXERR) { // the driver restarts the controller
		memset(c->seen, 0, sizeof(c->seen));
	} else if (reg == CMR && (value & CMR_ABORT)) {
		c->request = 0;
	} else if (reg == CMR && (value & (CMR_TRANSMIT | CMR_SELF_RECEPTION)) && wire_of(c) != SOUND) {
		c->request = value;
		regs->dx = 0; // the chip gets no command now; the timer's function sends the frame later
		hrtimer_start(&c->timer, ns_to_ktime(c->wire == SLOW ? c->frame_us * 1000ULL : step_ns), HRTIMER_MODE_REL);
	}
	return 0;
}

struct reading {
	struct controller *controller;
	unsigned int reg;
};

static int before_read(struct kretprobe_instance *instance, struct pt_regs *regs)
{
	struct reading *reading = (struct reading *)instance->data;

	reading->controller = controller_of((const void *)regs->di);
	reading->reg = (unsigned int)regs->si;
	return reading->controller && reading->reg < REGS ? 0 : 1; // 1: the kernel does not call after_read()
}

static int after_read(struct kretprobe_instance *instance, struct pt_regs *regs)
{
	const struct reading *reading = (const struct reading *)instance->data;
	struct controller *c = reading->controller;
	u8 value = (u8)regs->ax;

	switch (reading->reg) {
	case IR:
		value |= c->seen[IR];
		c->seen[IR] = 0; // reading this register clears it
		break;
	case SR:
		value |= c->seen[SR];
		if (c->request)
			value &= ~SR_TX_BUFFER_FREE;
		break;
	case ECC:
	case ALC:
	case RXERR:
	case TXERR:
		value = c->seen[reading->reg];
		break;
	}
	regs->ax = value;
	return 0;
}

static struct kprobe on_write = {.symbol_name = "kvaser_pci_write_reg", .pre_handler = before_write};
static struct kretprobe on_read = {.kp.symbol_name = "kvaser_pci_read_reg",
				   .entry_handler = before_read,
				   .handler = after_read,
				   .data_size = sizeof(struct reading),
				   .maxactive = 16};

static int set_wire(const char *text, const struct kernel_param *param)
{
	unsigned int index, ir, sr, ecc, alc, txerr, rxerr, us = 0;
	char word[8];
	struct controller *c;
	int i;

	if (sscanf(text, "can%u %7s %u", &index, word, &us) < 2 || index > 1)
		return -EINVAL;
	c = &controllers[index];
	if (!strcmp(word, "raise")) {
		if (!c->dev || sscanf(text, "can%u raise %x %x %x %x %x %x", &index, &ir, &sr, &ecc, &alc, &txerr, &rxerr) != 7)
			return -EINVAL;
		raise(c, ir, sr, ecc, alc, txerr, rxerr);
		return 0;
	}
	i = match_string(names, ARRAY_SIZE(names), word);
	if (i < 0)
		return i;
	c->frame_us = us;
	c->wire = i;
	if (c->request)
		hrtimer_start(&c->timer, ns_to_ktime(step_ns), HRTIMER_MODE_REL);
	return 0;
}
static const struct kernel_param_ops wire_ops = {.set = set_wire};
module_param_cb(wire, &wire_ops, NULL, 0200);

static int __init start(void)
{
	int i, error;

	for (i = 0; i < 2; ++i) {
		hrtimer_init(&controllers[i].timer, CLOCK_MONOTONIC, HRTIMER_MODE_REL_HARD);
		controllers[i].timer.function = next_stage;
	}
	error = register_kprobe(&on_write);
	if (error)
		return error;
	error = register_kretprobe(&on_read);
	if (error)
		unregister_kprobe(&on_write);
	return error;
}

static void __exit end(void)
{
	int i;

	unregister_kretprobe(&on_read);
	unregister_kprobe(&on_write);
	for (i = 0; i < 2; ++i)
		hrtimer_cancel(&controllers[i].timer);
}
module_init(start);
module_exit(end);
