// The dialog about what feeds the robot; what stands in it comes when it is wanted.

import { useRobot } from '../stores.ts';
import { Dialog } from '../../ui/Dialog.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { words } from '../../i18n/whole.ts';

const BatteryForm = laterComponent(async () => (await import('./BatteryForm.tsx')).BatteryForm, '40vh');

export interface BatterySettingsProps {
  readonly isOpen: boolean;
  onClose(): void;
}

export function BatterySettings({ isOpen, onClose }: BatterySettingsProps) {
  const robot = useRobot();
  return (
    <Dialog
      title={words.battery.settingsOf({ robot: robot.name })}
      closeLabel={words.close}
      {...{ isOpen, onClose }}
    >
      <BatteryForm robot={robot} />
    </Dialog>
  );
}
